#include "engine/render/passes/sky.h"

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "engine/render/passes/shadow_casters.h"
#include "shaders/shared/bindings.h"

namespace tyndall {
namespace {

const ProgramDesc cube_program{"sky/cube", {{GL_COMPUTE_SHADER, "shaders/engine/sky_cube.comp"}}, {}, {}};
const ProgramDesc irradiance_program{
    "sky/irradiance", {{GL_COMPUTE_SHADER, "shaders/engine/sky_irradiance.comp"}}, {}, {}};
const ProgramDesc background_program{
    "sky/background",
    {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "shaders/engine/sky_background.frag"}},
    {{"CIRRUS", {0, 1}}},
    {}};
const ProgramRegistry::Registration registrations[] = {ProgramRegistry::Registration(cube_program),
                                                       ProgramRegistry::Registration(irradiance_program),
                                                       ProgramRegistry::Registration(background_program)};

constexpr int radiance_size = 128, irradiance_size = 16;
constexpr int irradiance_source_level = 4;  // 8 texels a side are plenty for a cosine lobe

/// Writes level 0 of a cube, then its mips.
void fill_cube(GLuint cube, int size) {
    glBindImageTexture(0, cube, 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    const auto groups = static_cast<GLuint>((size + 7) / 8);
    glDispatchCompute(groups, groups, 6);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
    glGenerateTextureMipmap(cube);
}

}  // namespace

SkyPass::Output SkyPass::add(FrameContext& frame) {
    sun_ = {.to_sun = {0, 1, 0}, .light_unit = frame.scene.light_unit()};
    if (const auto sun = frame.scene.sun()) {
        sun_.to_sun = -glm::vec3(frame.frame.sun_direction);
        sun_.illuminance = glm::dot(frame.scene.lights[*sun].intensity, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    }
    if (!radiance_) {
        radiance_ = gl::Texture({gl::TextureKind::cube, GL_RGBA16F, {radiance_size, radiance_size, 1}, 0}, "sky");
        irradiance_ =
            gl::Texture({gl::TextureKind::cube, GL_RGBA16F, {irradiance_size, irradiance_size, 1}, 0}, "ambient");
    }
    Output sky{frame.passes.import("sky", radiance_), frame.passes.import("ambient", irradiance_)};
    constexpr const char* unchanged = "the sun and the exposure have not changed";
    if (sun_ == drawn_)
        frame.passes.skip("sky/cube", unchanged);
    else
        add_cube(frame, sky);
    if (!frame.facts.has_ambient)
        frame.passes.skip("sky/irradiance", "ambient light is off");
    else if (sun_ == irradiance_drawn_)
        frame.passes.skip("sky/irradiance", unchanged);
    else
        add_irradiance(frame, sky);
    return sky;
}

void SkyPass::add_cube(FrameContext& frame, Output& sky) {
    frame.passes.add(
        "sky/cube", [&](PassBuilder& pass) { sky.radiance = pass.storage_write(sky.radiance); },
        [this, &frame](const PassContext&) {
            const gl::Program& shader = frame.shaders.get(cube_program);
            shader.set("to_sun", sun_.to_sun);
            shader.set("illuminance", sun_.illuminance);
            shader.set("light_unit", sun_.light_unit);
            shader.use();
            fill_cube(radiance_.id(), radiance_size);
            drawn_ = sun_;
        });
}

void SkyPass::add_irradiance(FrameContext& frame, Output& sky) {
    frame.passes.add(
        "sky/irradiance",
        [&](PassBuilder& pass) {
            pass.sample(sky.radiance);
            sky.irradiance = pass.storage_write(sky.irradiance);
        },
        [this, &frame](const PassContext&) {
            const gl::Program& shader = frame.shaders.get(irradiance_program);
            shader.set("level", irradiance_source_level);
            shader.use();
            glBindTextureUnit(0, radiance_.id());
            glBindSampler(0, 0);
            fill_cube(irradiance_.id(), irradiance_size);
            irradiance_drawn_ = sun_;
        });
}

TextureRef SkyPass::add_background(FrameContext& frame, const Output& sky, TextureRef depth, TextureRef color) {
    frame.passes.add(
        "sky/background",
        [&](PassBuilder& pass) {
            pass.sample(sky.radiance);
            color = pass.attach_color(color);
            pass.attach_depth_read_only(depth);
        },
        [this, &frame](const PassContext& pass) {
            pass.bind_framebuffer();
            // The triangle lies at depth 0: it passes where nothing nearer was drawn.
            gl::apply({.depth_test = true});
            const gl::Program& shader =
                frame.shaders.get(background_program, {{"CIRRUS", !has_clouds(frame.scene.media)}});
            shader.set("to_sun", sun_.to_sun);
            shader.set("illuminance", sun_.illuminance / sun_.light_unit);
            shader.use();
            glBindTextureUnit(0, radiance_.id());
            glBindSampler(0, 0);
            gl::draw_fullscreen();
        });
    return color;
}

std::uint64_t SkyPass::key() const {
    ShadowKey key;
    key.add(glm::vec4(sun_.to_sun, sun_.illuminance));
    key.add(std::span(&sun_.light_unit, 1));
    return key.value();
}

void SkyPass::bind_ambient() const {
    glBindTextureUnit(UNIT_AMBIENT, irradiance_.id());
    glBindSampler(UNIT_AMBIENT, 0);
}

}  // namespace tyndall
