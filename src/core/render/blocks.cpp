#include "core/render/blocks.h"

#include "core/scene/camera.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <bit>
#include <cstddef>
#include <map>

namespace mb {
namespace {

GpuExtra gpuExtra(const Extra& extra) {
    GpuExtra packed;
    for (std::size_t i = 0; i < extra.size(); ++i) packed[i / 4][static_cast<int>(i % 4)] = static_cast<float>(extra[i]);
    return packed;
}
glm::vec4 with(glm::dvec3 v, double w) { return {glm::vec3(v), static_cast<float>(w)}; }

GpuMaterial packMaterial(const Material& m) {
    return {with(m.color, m.ka), with(m.color2, m.kd), {m.ks, m.kr, m.c, m.pattern == Pattern::checker ? 1 : 0}, gpuExtra(m.extra)};
}

GpuNode packNode(glm::dvec3 position, double w, const glm::dmat3& rotation, const LeafNumbers& k, double object, std::ptrdiff_t row) {
    return {with(position, w), glm::vec4(k[0], k[1], k[2], k[3]), with(rotation[0], object), with(rotation[1], static_cast<double>(row)), with(rotation[2], 0)};
}

/// A leaf without bounds, its origin moved near `eye`: what is computed from the way to an origin far away is lost to
/// rounding. The move is by even whole metres of its own frame, so that its checkerboard stays where it is.
Leaf nearEye(Leaf leaf, glm::dvec3 eye) {
    if (!leaf.primitive->moveOrigin || leaf.warps > 0) return leaf;
    const glm::dvec3 by = 2.0 * glm::round(0.5 * ((eye - leaf.position) * leaf.rotation));
    leaf.primitive->moveOrigin(leaf.numbers, {by.x, by.y, by.z});
    leaf.position += leaf.rotation * by;
    return leaf;
}

/// The largest number the leaf's distance may be computed from: of a bounded one its size, of an unbounded one how far its
/// own origin lies from the eye; behind a warp, where it lies there.
double reachOf(const Leaf& leaf, glm::dvec3 position) {
    const Box box = leaf.primitive->extent(leaf.numbers);
    double reach = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double size = std::max(std::fabs(box.lo[i]), std::fabs(box.hi[i]));
        reach = std::max(reach, std::isfinite(size) ? size : glm::length(position));
    }
    return leaf.warps > 0 ? reach + glm::length(position) : reach;
}

}  // namespace

Packed pack(const Scene& scene, const Tree& tree, glm::dvec3 origin) {
    Packed packed;
    std::map<int, int> numbers;  // of the materials some leaf shows, in the order of their first use
    for (const Leaf& placed : tree.leaves) {
        const Leaf leaf = nearEye(placed, origin);
        const auto [number, is_new] = numbers.try_emplace(leaf.material, static_cast<int>(numbers.size()));
        if (is_new) packed.materials.push_back(packMaterial(materialOf(scene, leaf.material)));
        const glm::dvec3 position = leaf.warps > 0 ? leaf.position : leaf.position - origin;
        packed.leaves.push_back(packNode(position, number->second, leaf.rotation, leaf.numbers, leaf.object, leaf.primitive - primitives().data()));
        packed.reach = std::max(packed.reach, static_cast<float>(reachOf(leaf, position)));
    }
    packed.reach *= static_cast<float>(1 + tree.warps);  // each warp rounds the point once more
    // The array's size is part of the shader: a power of two, so that giving an object another material seldom changes it.
    constexpr std::size_t kFewest = 16;
    packed.materials.resize(std::bit_ceil(std::max(packed.materials.size(), kFewest)), packMaterial({}));
    for (const Branch& branch : tree.branches)
        packed.branches.push_back(packNode(branch.warps > 0 ? branch.position : branch.position - origin, branch.blend, branch.rotation,
                                           branch.numbers, 0, branch.op - operators().data()));
    for (const Light& light : scene.lights)
        packed.lights.push_back({with(light.pos - origin, 1), with(light.color * light.intensity, 1), gpuExtra(light.extra)});
    return packed;
}

GpuFrame packFrame(const Scene& scene, const Camera& camera, const Raster& raster, int bounces) {
    const View view = viewOf(camera);
    const double aspect = static_cast<double>(raster.size.x) / raster.size.y;
    const RenderKnobs& knobs = scene.render;

    GpuFrame frame{};
    frame.right = with(view.right * view.half * aspect, view.parallel);
    frame.up = with(view.up * view.half, 0);
    frame.forward = with(view.forward, 2 * view.half / (static_cast<double>(raster.drawn.y) * raster.stride));
    frame.picture = {raster.drawn.x, raster.drawn.y, 0, 0};
    frame.reach = {knobs.march_epsilon, knobs.max_distance, knobs.normal_epsilon, 0};
    frame.march = {knobs.relaxation, knobs.bias, 0, 0};
    frame.background = with(scene.world.background, 1);
    frame.limits = {knobs.march_steps, knobs.shadow_steps, bounces, knobs.show_undecided};
    frame.world_extra = gpuExtra(scene.world.extra), frame.render_extra = gpuExtra(knobs.extra);
    frame.counted = glm::ivec4{-1};
    return frame;
}

std::span<const BlockMember> blockMembers() {
#define MB_AT(type, member, name) BlockMember{name, offsetof(type, member)}
    static constexpr BlockMember kMembers[] = {
        MB_AT(GpuFrame, right, "frame.right"), MB_AT(GpuFrame, up, "frame.up"), MB_AT(GpuFrame, forward, "frame.forward"),
        MB_AT(GpuFrame, picture, "frame.picture"), MB_AT(GpuFrame, reach, "frame.reach"), MB_AT(GpuFrame, march, "frame.march"),
        MB_AT(GpuFrame, background, "frame.background"), MB_AT(GpuFrame, limits, "frame.limits"), MB_AT(GpuFrame, pass, "frame.pass"),
        MB_AT(GpuFrame, grid_corner, "frame.grid_corner"), MB_AT(GpuFrame, box_lo, "frame.box_lo"), MB_AT(GpuFrame, box_hi, "frame.box_hi"),
        MB_AT(GpuFrame, grid_size, "frame.grid_size"), MB_AT(GpuFrame, world_extra, "frame.world_extra"),
        MB_AT(GpuFrame, render_extra, "frame.render_extra"), MB_AT(GpuFrame, counted, "frame.counted"),
        MB_AT(GpuNode, position, "leaves[0].position"), MB_AT(GpuNode, x_axis, "leaves[0].x_axis"),
        MB_AT(GpuNode, y_axis, "leaves[0].y_axis"), MB_AT(GpuNode, z_axis, "leaves[0].z_axis"), MB_AT(GpuNode, numbers, "leaves[0].numbers"),
        MB_AT(GpuMaterial, color, "materials[0].color"), MB_AT(GpuMaterial, color2, "materials[0].color2"),
        MB_AT(GpuMaterial, phong, "materials[0].phong"), MB_AT(GpuMaterial, extra, "materials[0].extra"),
        MB_AT(GpuLight, position, "lights[0].position"),
        MB_AT(GpuLight, color, "lights[0].color"), MB_AT(GpuLight, extra, "lights[0].extra"),
        {"leaves[1].position", sizeof(GpuNode)}, {"materials[1].color", sizeof(GpuMaterial)}, {"lights[1].position", sizeof(GpuLight)},
    };
#undef MB_AT
    return kMembers;
}

}  // namespace mb
