#pragma once
// What the tests of the setting temporal share: a host whose frames follow each other.

#include <glm/gtc/matrix_transform.hpp>

#include "engine/gl/readback.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {

using volumetrics::Temporal;
using volumetrics::TemporalPlace;

/// Of the first channel.
inline double mean_of(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x) sum += image.at(x, y)[0];
    return sum / (image.size.x * image.size.y);
}

class VolumetricsTemporal : public GlTest {
  protected:
    struct Picture {
        Image scattering, acceptance;
    };
    StubHost host, other;
    float turn = 0;      ///< of the camera about +Y, rad
    gl::Texture motion;  ///< of every pixel, see Inputs::motion
    bool asks_acceptance = true;

    VolumetricsTemporal() {
        host.size = {16, 8};
        host.ambient = glm::vec3(1);
        host.global = {{.sigma_s = glm::vec3(0.02F), .anisotropy = 0.3F}};
    }

    /// Neither clips nor rejects.
    static Settings settings(Temporal temporal, float weight = 0.1F) {
        Settings s = plain_settings(4);
        s.temporal.mode = temporal;
        s.temporal.place = TemporalPlace::after;
        s.temporal.weight = weight;
        s.temporal.scale = 4;
        s.temporal.clip = false;
        s.temporal.reject = false;
        return s;
    }
    /// White noise of few steps, other in each frame; the rest as it comes.
    static Settings noisy(Temporal temporal) {
        Settings s = plain_settings(4);
        s.temporal.mode = temporal;
        s.temporal.place = TemporalPlace::after;
        s.noise.kind = volumetrics::Noise::white;
        s.noise.time = volumetrics::NoiseTime::own;
        return s;
    }
    static Settings without(Settings s) {
        s.temporal.mode = Temporal::off;
        return s;
    }

    Picture draw(const Settings& s) {
        const Picture picture = draw(host, s);
        ++host.frame_index;
        return picture;
    }
    Picture draw(StubHost& host, const Settings& s) {
        PassList passes;
        Inputs in = host.inputs(passes);
        in.view = glm::rotate(glm::mat4(1), turn, glm::vec3(0, 1, 0)) * in.view;
        if (motion) in.motion = passes.import("motion", motion);
        in.acceptance = asks_acceptance;
        host.volumetrics().prepare(in, s);
        const volumetrics::Outputs out = host.volumetrics().add_passes(passes, in, s);
        passes.export_texture(out.scattering);
        if (out.acceptance) passes.export_texture(out.acceptance);
        passes.compile();
        passes.execute(pool_);
        const auto read = [&](TextureRef ref) {
            if (!ref) return Image();
            const PassList::TextureInfo info = passes.info(ref);
            return gl::read_texture(gl::TextureView(info.id, info.desc));
        };
        return {read(out.scattering), read(out.acceptance)};
    }
    /// Mean acceptance of the next frame.
    double accepted(const Settings& s) { return mean_of(draw(s).acceptance); }
    Picture after(int frames, const Settings& s) {
        Picture picture;
        for (int i = 0; i < frames; ++i) picture = draw(s);
        return picture;
    }
    /// Without touching the history: by another host.
    Image of_other(const Settings& s) {
        other.size = host.size;
        other.eye = host.eye;
        other.view_depth = host.view_depth;
        other.global = host.global;
        other.has_sun = host.has_sun;
        other.sun_direction = host.sun_direction;
        other.sun_illuminance = host.sun_illuminance;
        other.ambient = host.ambient;
        other.lights = host.lights;
        other.shadows = host.shadows;
        other.frame_index = host.frame_index;
        return draw(other, s).scattering;
    }

    void add_sun_behind_fence() {
        host.has_sun = true;
        host.sun_direction = glm::normalize(glm::vec3(0.4F, -1, -0.5F));
        host.sun_illuminance = glm::vec3(1000);
        host.shadows = 1;
    }
    void set_shadowed_lamp(glm::vec3 place, float intensity, float range = 30) {
        host.lights = {point_light(place, intensity, range)};
        host.lights[0].cone_shadow.z = 0;
    }
    void set_motion(glm::vec2 uv) {
        motion = gl::Texture({.format = GL_RG16F, .size = {host.size, 1}}, "test motion");
        motion.clear_float(uv.x, uv.y, 0, 0);
    }

  private:
    TransientPool pool_;
};

}  // namespace tyndall::test
