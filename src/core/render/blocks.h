#pragma once
// The std140 blocks of shaders/lib/blocks.glsl as C++: vec4 records only, so that both sides agree; a test asks the driver.
#include "core/effects/plan.h"
#include "core/render/enlarge.h"
#include "core/sdf/tree.h"

#include <glm/vec4.hpp>

#include <array>
#include <string>
#include <string_view>

namespace mb {

using GpuExtra = std::array<glm::vec4, 2>;
struct GpuNode {
    glm::vec4 position, numbers, x_axis, y_axis, z_axis;
};
struct GpuMaterial {
    glm::vec4 color, color2, phong;
    GpuExtra extra;
};
struct GpuLight {
    glm::vec4 position, color;
    GpuExtra extra;
};
struct GpuFrame {
    glm::vec4 right, up, forward, picture, reach, march, background;
    glm::ivec4 limits;
    glm::vec4 grid_corner, box_lo, box_hi;
    glm::ivec4 grid_size, pass;
    GpuExtra world_extra, render_extra;
    glm::ivec4 counted;
};

/// Everything the shader reads of a scene, but the frame: packed anew for each frame, relative to an origin.
struct Packed {
    std::vector<GpuNode> leaves, branches;
    std::vector<GpuMaterial> materials;  // those that some leaf shows
    std::vector<GpuLight> lights;
    float reach = 0;                     // the largest length a leaf's distance is computed from
};
Packed pack(const Scene& scene, const Tree& tree, glm::dvec3 origin);

/// The camera's basis and the knobs, for a picture of those pixels whose rays are reflected at most `bounces` times.
GpuFrame packFrame(const Scene& scene, const Camera& camera, const Raster& raster, int bounces);

/// A member of a block for the test that compares offsets: its name in GLSL and where C++ has it.
struct BlockMember {
    const char* name;
    std::size_t offset;
};
std::span<const BlockMember> blockMembers();

}  // namespace mb
