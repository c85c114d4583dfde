// What a picture takes, counted by a program with counters, and its other channels.
#include "core/render/renderer.h"

#include <array>
#include <utility>

namespace mb {
namespace {

/// Adds what the counters of one pass say (shaders/fragment.glsl).
void addCounts(const Targets& channels, Counts& c) {
    const auto sums = [&](int attachment) {
        std::array<std::uint64_t, 4> sum{};
        const std::vector<float> texels = channels.read(attachment);
        for (std::size_t i = 0; i < texels.size(); ++i) sum[i % 4] += static_cast<std::uint64_t>(texels[i]);
        return sum;
    };
    const auto primary = sums(3);
    c.evaluations.primary += primary[0], c.touched.primary += primary[1], c.evaluations.normal += primary[2], c.touched.normal += primary[3];
    constexpr std::pair<int, std::uint64_t Counts::ByKind::*> kRays[] = {{4, &Counts::ByKind::shadow}, {5, &Counts::ByKind::reflection},
                                                                        {6, &Counts::ByKind::soft}, {7, &Counts::ByKind::occlusion}};
    for (const auto& [attachment, kind] : kRays) {
        const auto ray = sums(attachment);
        c.evaluations.*kind += ray[0], c.touched.*kind += ray[1], c.rays.*kind += ray[2], c.undecided_rays.*kind += ray[3];
    }
    const glm::ivec2 size = channels.size();
    c.rays.primary += static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
    const std::vector<float> ray = channels.read(2);
    for (std::size_t i = 3; i < ray.size(); i += 4) c.uses += static_cast<std::uint64_t>(ray[i]);
}

}  // namespace

std::string Renderer::measure(const Scene& scene, const Camera& camera, const Raster& raster, Measured& out, const Effect* counted) {
    Ready ready = prepare(scene, camera, raster, Variant::counted, camera.eye);
    if (!ready.program) return ready.why;
    if (counted) ready.frame.counted.x = static_cast<int>(numberOf(*counted));
    channels_ = Targets(raster.drawn, kChannelAttachments);
    out = {};
    const std::size_t pixels = static_cast<std::size_t>(raster.drawn.x) * static_cast<std::size_t>(raster.drawn.y);

    // The counters of every pass that a picture takes.
    eachPass(scene, ready, [&] {
        channels_.clear();
        quad_.draw();
        addCounts(channels_, out.counts);
    });

    // The channels of the pixels' centres.
    GpuFrame centre = ready.frame;
    centre.pass = {0, 0, 1, centre.pass.w};
    bindFrame(centre);
    channels_.clear();
    quad_.draw();
    const std::vector<float> surface = channels_.read(1), ray = channels_.read(2);
    Channels& c = out.channels;
    c.size = raster.size;
    c.depth.resize(pixels), c.normal.resize(pixels), c.object.resize(pixels), c.steps.resize(pixels), c.state.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        c.normal[i] = {surface[4 * i], surface[4 * i + 1], surface[4 * i + 2]};
        c.depth[i] = surface[4 * i + 3];
        c.object[i] = ray[4 * i], c.steps[i] = ray[4 * i + 1], c.state[i] = ray[4 * i + 2];
        out.counts.pixels.hit += c.state[i] == 1, out.counts.pixels.miss += c.state[i] == 0, out.counts.pixels.undecided += c.state[i] == 2;
    }
    const auto enlarge = [&](auto& channel) { channel = enlargedByNearest(std::move(channel), raster.drawn, raster.size); };
    enlarge(c.depth), enlarge(c.normal), enlarge(c.object), enlarge(c.steps), enlarge(c.state);
    return {};
}

}  // namespace mb
