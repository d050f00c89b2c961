#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "engine/core/error.h"
#include "reference/slice.h"
#include "reference/slice_mask.h"

namespace tyndall::reference {
namespace {

constexpr unsigned branching = 4;

/// As Embree's builder makes it, before it is laid out flat.
struct BuiltNode {
    unsigned count = 0;  ///< children, or casters of a leaf
    bool leaf = false;
    std::array<BuiltNode*, branching> child{};
    std::array<RTCBounds, branching> bounds{};
    std::array<unsigned, branching> caster{};
};

BuiltNode* new_node(RTCThreadLocalAllocator allocator) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(BuiltNode), alignof(BuiltNode))) BuiltNode;
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned count, void*) {
    BuiltNode* const node = new_node(allocator);
    node->count = count;
    return node;
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                  void*) {
    BuiltNode* const node = new_node(allocator);
    node->leaf = true;
    node->count = static_cast<unsigned>(count);
    for (std::size_t i = 0; i < count; ++i) node->caster[i] = primitives[i].primID;
    return node;
}

void set_children(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<BuiltNode*>(node)->child[i] = static_cast<BuiltNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i) static_cast<BuiltNode*>(node)->bounds[i] = *bounds[i];
}

RTCBuildPrimitive primitive(const Caster& caster, dvec3 center, unsigned index) {
    const auto& [a, b, c] = caster.corner;
    const glm::vec3 low(glm::min(a, glm::min(b, c)) - center), high(glm::max(a, glm::max(b, c)) - center);
    return {low.x, low.y, low.z, 0, high.x, high.y, high.z, index};
}

/// An affine function scaled to a gradient of length 1, in single precision, for boxes around the tree's centre.
struct BoxTest {
    glm::vec3 gradient, size;  ///< size: absolute values
    float constant, error;

    BoxTest(const Affine& exact, dvec3 center) {
        const double length = glm::length(exact.gradient), scale = length > 0 ? 1 / length : 1.0;
        gradient = glm::vec3(exact.gradient * scale);
        size = glm::abs(gradient);
        constant = static_cast<float>(exact(center) * scale);
        error = 1e-6f * std::abs(constant);
    }
    template <class Node>
    [[nodiscard]] float at(const Node& node, int i) const {
        return gradient.x * node.center[0][i] + gradient.y * node.center[1][i] + gradient.z * node.center[2][i] +
               constant;
    }
    template <class Node>
    [[nodiscard]] float reach(const Node& node, int i) const {
        return size.x * node.extent[0][i] + size.y * node.extent[1][i] + size.z * node.extent[2][i] + error;
    }
};

Affine combined(double a, const Affine& f, double b, const Affine& g) {
    return {f.base, a * f.gradient + b * g.gradient, a * f.constant + b * g.constant};
}

}  // namespace

/// Lays out what Embree built: children before their parents, casters in the order of the leaves.
struct SliceTreeBuild {
    SliceTree& tree;
    const std::vector<Caster>& casters;

    void lane(SliceTree::Node& to, unsigned i, const RTCBounds& box) const {
        const float low[3] = {box.lower_x, box.lower_y, box.lower_z},
                    high[3] = {box.upper_x, box.upper_y, box.upper_z};
        for (int axis = 0; axis < 3; ++axis) {
            const float middle = 0.5f * (low[axis] + high[axis]);
            to.center[axis][i] = middle;
            // A millionth more than covers the rounding of the box and of the test.
            const float half = std::max(high[axis] - middle, middle - low[axis]);
            to.extent[axis][i] = half + 1e-6f * (std::abs(middle) + half) + 1e-12f;
        }
    }

    void leaf(SliceTree::Node& to, unsigned i, const BuiltNode& from) const {
        to.child[i] = static_cast<std::int32_t>(tree.casters_.size());
        to.count[i] = static_cast<std::int32_t>(from.count);
        for (unsigned k = 0; k < from.count; ++k) tree.casters_.push_back(casters[from.caster[k]]);
    }

    std::int32_t inner(const BuiltNode& from) const {
        SliceTree::Node node{};
        for (auto& axis : node.extent) std::ranges::fill(axis, -std::numeric_limits<float>::max());
        for (unsigned i = 0; i < from.count; ++i) {
            lane(node, i, from.bounds[i]);
            if (from.child[i]->leaf)
                leaf(node, i, *from.child[i]);
            else
                node.child[i] = inner(*from.child[i]);
        }
        tree.nodes_.push_back(node);
        return static_cast<std::int32_t>(tree.nodes_.size()) - 1;
    }
};

SliceTree::SliceTree(const Scene& scene, std::vector<Caster> casters, dvec3 center)
    : scene_(scene), center_(center) {
    if (casters.empty()) return;
    std::vector<RTCBuildPrimitive> primitives;
    for (std::size_t i = 0; i < casters.size(); ++i)
        primitives.push_back(primitive(casters[i], center, static_cast<unsigned>(i)));

    const std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device(rtcNewDevice(nullptr), rtcReleaseDevice);
    if (!device) throw Error("Embree: no device");
    const std::unique_ptr<RTCBVHTy, decltype(&rtcReleaseBVH)> bvh(rtcNewBVH(device.get()), rtcReleaseBVH);
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.bvh = bvh.get();
    arguments.maxBranchingFactor = branching;
    arguments.maxLeafSize = branching;
    arguments.maxDepth = 64;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.createLeaf = create_leaf;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    const auto* const root = static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
    if (root == nullptr) throw Error("Embree: no hierarchy of boxes");

    casters_.reserve(casters.size());
    const SliceTreeBuild build{*this, casters};
    if (root->leaf) {
        BuiltNode above;
        above.count = root->count;
        std::vector<BuiltNode> leaves(root->count);
        for (unsigned i = 0; i < root->count; ++i) {
            leaves[i].leaf = true;
            leaves[i].count = 1;
            leaves[i].caster[0] = root->caster[i];
            const RTCBuildPrimitive box = primitive(casters[root->caster[i]], center, 0);
            above.bounds[i] = {box.lower_x, box.lower_y, box.lower_z, 0, box.upper_x, box.upper_y, box.upper_z, 0};
            above.child[i] = &leaves[i];
        }
        build.inner(above);
    } else {
        build.inner(*root);
    }
}

template <class Visit>
void SliceTree::visit(const Slice& slice, Visit leaf) const {
    if (nodes_.empty()) return;
    const BoxTest plane(slice.plane, center_);
    const BoxTest half_spaces[3] = {
        BoxTest(slice.above, center_),
        BoxTest(combined(1, slice.numerator, -slice.begin, slice.denominator), center_),
        BoxTest(combined(-1, slice.numerator, slice.end, slice.denominator), center_),
    };
    std::vector<std::int32_t> stack{static_cast<std::int32_t>(nodes_.size()) - 1};
    while (!stack.empty()) {
        const Node& node = nodes_[static_cast<std::size_t>(stack.back())];
        stack.pop_back();
        float inside[4];  // how far a box reaches into what is sought
        for (int i = 0; i < 4; ++i) inside[i] = plane.reach(node, i) - std::abs(plane.at(node, i));
        for (const BoxTest& test : half_spaces)
            for (int i = 0; i < 4; ++i) inside[i] = std::min(inside[i], test.at(node, i) + test.reach(node, i));
        for (int i = 0; i < 4; ++i) {
            if (inside[i] < 0) continue;
            if (node.count[i] == 0) {
                stack.push_back(node.child[i]);
                continue;
            }
            for (std::int32_t k = 0; k < node.count[i]; ++k)
                leaf(casters_[static_cast<std::size_t>(node.child[i] + k)]);
        }
    }
}

std::vector<SliceTree::Cut> SliceTree::cuts(const Slice& slice) const {
    std::vector<Cut> found;
    visit(slice, [&](const Caster& caster) {
        if (const auto shadow = cut(caster, slice)) found.push_back({caster.triangle, *shadow});
    });
    return found;
}

std::vector<Interval> SliceTree::dark(const Slice& slice) const {
    struct Masked {
        const Caster* caster;
        Shadow shadow;
    };
    std::vector<Interval> found;
    std::vector<Masked> masked;
    const auto add = [&](Interval interval) {
        if (interval.begin < interval.end) found.push_back(interval);
    };
    visit(slice, [&](const Caster& caster) {
        const auto shadow = cut(caster, slice);
        if (!shadow) return;
        if (caster.mask == nullptr)
            add(shadow->on_ray(shadow->part, slice));
        else
            masked.push_back({&caster, *shadow});
    });
    merge(found);
    if (masked.empty()) return found;

    // Walking along a mask is slow: not for what is dark anyway.
    const std::vector<Interval> opaque = found;
    for (const auto& [caster, shadow] : masked) {
        const Interval whole = shadow.on_ray(shadow.part, slice);
        const auto after = std::ranges::upper_bound(opaque, whole.begin, {}, &Interval::begin);
        if (after != opaque.begin() && std::prev(after)->end >= whole.end) continue;
        const auto uv = [&](dvec3 w) { return w.x * caster->uv[0] + w.y * caster->uv[1] + w.z * caster->uv[2]; };
        const auto point = [&](dvec3 w) { return MaskPoint{uv(w), glm::dot(w, caster->alpha)}; };
        for (const Interval& part :
             opaque_parts(scene_, *caster->mask, point(shadow.weights[0]), point(shadow.weights[1]), shadow.part))
            add(shadow.on_ray(part, slice));
    }
    merge(found);
    return found;
}

}  // namespace tyndall::reference
