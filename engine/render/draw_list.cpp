#include "engine/render/draw_list.h"

#include <array>
#include <cstdint>

namespace tyndall {
namespace {

/// As glMultiDrawElementsIndirect reads it.
struct DrawElementsIndirectCommand {
    std::uint32_t count, instance_count, first_index;
    std::int32_t base_vertex;
    std::uint32_t base_instance;
};

bool passes(const GpuScene& scene, const Instance& instance, DrawList::Filter filter) {
    const bool transparent = scene.material(instance.material).alpha_blend;
    switch (filter) {
        case DrawList::Filter::all:
            return !transparent;
        case DrawList::Filter::static_shadow_casters:
            return instance.cast_shadow && !transparent && !instance.dynamic;
        case DrawList::Filter::moving_shadow_casters:
            return instance.cast_shadow && !transparent && instance.dynamic;
        case DrawList::Filter::glass:
            return instance.cast_shadow && transparent;
        case DrawList::Filter::static_glass:
            return instance.cast_shadow && transparent && !instance.dynamic;
    }
    return false;
}

/// The boxes of the candidates, one array per coordinate, so that the compiler tests several at once.
struct Boxes {
    std::vector<std::uint32_t> instance;
    std::array<std::vector<float>, 3> center, extent;

    Boxes(const GpuScene& scene, DrawList::Filter filter) {
        const auto instances = scene.instances();
        for (std::size_t i = 0; i < instances.size(); ++i) {
            if (!passes(scene, instances[i], filter)) continue;
            instance.push_back(static_cast<std::uint32_t>(i));
            const Aabb& box = instances[i].bounds;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const int a = static_cast<int>(axis);
                center[axis].push_back((box.min[a] + box.max[a]) * 0.5f);
                extent[axis].push_back((box.max[a] - box.min[a]) * 0.5f);
            }
        }
    }

    /// `depth[i]`: signed distance, to the plane it is least inside of, of box i's corner that is deepest inside
    /// it; negative where the box is outside (Frustum::intersects is the same test for one box).
    void test(const Frustum& frustum, std::vector<float>& depth) const {
        depth.assign(instance.size(), 1.0f);
        float* out = depth.data();
        const float *cx = center[0].data(), *cy = center[1].data(), *cz = center[2].data();
        const float *ex = extent[0].data(), *ey = extent[1].data(), *ez = extent[2].data();
        for (int p = 0; p < frustum.count; ++p) {
            const glm::vec4 plane = frustum.planes[static_cast<std::size_t>(p)];
            const glm::vec3 size = glm::abs(glm::vec3(plane));
            for (std::size_t i = 0; i < instance.size(); ++i) {
                const float d = plane.x * cx[i] + plane.y * cy[i] + plane.z * cz[i] + size.x * ex[i] +
                                size.y * ey[i] + size.z * ez[i] + plane.w;
                out[i] = d < out[i] ? d : out[i];
            }
        }
    }
};

}  // namespace

void DrawList::build(const GpuScene& scene, const Frustum& frustum, Filter filter) {
    build(scene, std::span(&frustum, 1), filter);
}

void DrawList::build(const GpuScene& scene, std::span<const Frustum> frusta, Filter filter) {
    const Boxes boxes(scene, filter);
    std::vector<DrawElementsIndirectCommand> commands;
    std::vector<GpuScene::DrawnInstance> drawn;
    std::vector<float> depth;
    views_.clear();
    for (const Frustum& frustum : frusta) {
        ViewBatches& view = views_.emplace_back();
        boxes.test(frustum, depth);
        int last_mesh = -1;
        for (std::size_t i = 0; i < boxes.instance.size(); ++i) {
            if (depth[i] < 0) continue;
            const Instance& instance = scene.instances()[boxes.instance[i]];
            const GpuScene::MeshRange& range = scene.range(instance.mesh);
            const Surfaces surfaces{instance.material, instance.mirrored};
            const bool new_batch = view.batches.empty() || view.batches.back().surfaces != surfaces;
            if (new_batch) view.batches.push_back({surfaces, static_cast<std::uint32_t>(commands.size()), 0});
            if (new_batch || instance.mesh != last_mesh) {
                commands.push_back({range.index_count, 0, range.first_index, range.base_vertex,
                                    static_cast<std::uint32_t>(drawn.size())});
                ++view.batches.back().command_count;
                last_mesh = instance.mesh;
            }
            ++commands.back().instance_count;
            drawn.push_back(scene.drawn(boxes.instance[i]));
            ++view.instances;
            view.triangles += range.index_count / 3;
        }
    }
    commands_.assign(std::span<const DrawElementsIndirectCommand>(commands), "draw commands");
    drawn_.assign(std::span<const GpuScene::DrawnInstance>(drawn), "drawn instances");
}

void DrawList::draw(const GpuScene& scene, const std::function<bool(Surfaces)>& bind, int view) const {
    const ViewBatches& batches = views_.at(static_cast<std::size_t>(view));
    if (batches.batches.empty()) return;
    scene.bind(drawn_);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
    for (const Batch& batch : batches.batches) {
        if (!bind(batch.surfaces)) continue;
        const std::uintptr_t offset = batch.first_command * sizeof(DrawElementsIndirectCommand);
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset),
                                    static_cast<GLsizei>(batch.command_count), 0);
    }
}

std::size_t DrawList::instance_count(int view) const {
    return views_.at(static_cast<std::size_t>(view)).instances;
}

std::size_t DrawList::triangle_count(int view) const {
    return views_.at(static_cast<std::size_t>(view)).triangles;
}

std::size_t DrawList::draw_call_count(int view) const {
    return views_.at(static_cast<std::size_t>(view)).batches.size();
}

}  // namespace tyndall
