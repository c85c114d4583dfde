// marchbox eval: distance and gradient of the scene at points.
#include "cli/cli.h"

#include "core/render/renderer.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace mb::cli {
namespace {

struct Options {
    std::string scene, points, on = "cpu64";
    std::vector<std::string> settings;
};

struct Sample {
    double distance = 0;
    glm::dvec3 gradient{0};
    int object = -1;
};

/// A line `x,y,z`; or the column, from 1, where it is not one.
std::size_t parsePoint(const std::string& line, glm::dvec3& p) {
    const char* at = line.data();
    const char* const end = at + line.size();
    for (int i = 0; i < 3; ++i) {
        const auto [next, error] = std::from_chars(at, end, p[i]);
        const bool ends_well = i < 2 ? next != end && *next == ',' : next == end;
        if (error != std::errc{} || !ends_well || !std::isfinite(p[i]) || std::fabs(p[i]) > 1e9)
            return static_cast<std::size_t>(at - line.data()) + 1;
        at = next + 1;
    }
    return 0;
}

/// The points of a file of such lines; blank ones are skipped. Its faults are printed as a scene's are, up to as many.
std::vector<glm::dvec3> readPoints(const std::string& path) {
    std::error_code error;
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path, error))
        throw Failure{kDiskFault, fmt::format("{}: cannot read: {}", path, file ? "it is a folder" : std::strerror(errno))};
    std::vector<glm::dvec3> points;
    std::size_t faults = 0;
    std::string line;
    for (int number = 1; faults < kMaxFaults && std::getline(file, line); ++number) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.empty()) continue;
        glm::dvec3 p{0};
        if (const std::size_t column = parsePoint(line, p)) {
            const Fault fault{number, static_cast<int>(column), "expected three numbers x,y,z between -1e9 and 1e9"};
            fmt::print(stderr, "{}\n", describe(fault, path));
            ++faults;
        }
        points.push_back(p);
    }
    if (faults > 0) throw Failure{kInputFault, {}};
    return points;
}

template <class R> Sample evaluateOnCpu(const Tree& tree, glm::dvec3 p) {
    const Nearest<R> found = nearest<R>(tree, {static_cast<R>(p.x), static_cast<R>(p.y), static_cast<R>(p.z)});
    return {static_cast<double>(found.distance), slope(tree, p).gradient,
            found.leaf < 0 ? -1 : tree.leaves[static_cast<std::size_t>(found.leaf)].object};
}

std::vector<Sample> evaluateOnGpu(const Scene& scene, const std::vector<glm::dvec3>& points) {
    const auto context = headlessContext();
    Renderer renderer;
    std::vector<GpuSample> found;
    if (const std::string why = renderer.evaluate(scene, {points.begin(), points.end()}, found); !why.empty())
        throw Failure{kInputFault, why};
    std::vector<Sample> samples;
    for (const GpuSample& s : found) samples.push_back({static_cast<double>(s.distance), glm::dvec3(s.gradient), s.object});
    return samples;
}

void run(const Options& options, const Common& common) {
    const Scene scene = readSceneFile(options.scene, options.settings, common);
    const Tree tree = treeOf(scene);
    const std::vector<glm::dvec3> points = readPoints(options.points);
    std::vector<Sample> samples;
    if (options.on == "gpu") {
        samples = evaluateOnGpu(scene, points);
    } else {
        for (const glm::dvec3& p : points)
            samples.push_back(options.on == "cpu" ? evaluateOnCpu<float>(tree, p) : evaluateOnCpu<double>(tree, p));
    }

    std::string text;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 &p = points[i], &g = samples[i].gradient;
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n", p.x, p.y, p.z, samples[i].distance, g.x, g.y, g.z,
                       samples[i].object);
    }
    writeText("-", text);
}

std::function<void()> make(CLI::App& app, Common& common) {
    const auto options = std::make_shared<Options>();
    app.add_option("SCENE", options->scene, "scene file")->required();
    app.add_option("--points", options->points, "a file of lines x,y,z")->required();
    app.add_option("--on", options->on, "cpu (float), cpu64 (double) or gpu (the fragment shader's own functions)")
        ->check(CLI::IsMember({"cpu", "cpu64", "gpu"}))
        ->capture_default_str();
    addSettings(app, options->settings);
    return [options, &common] { run(*options, common); };
}

}  // namespace

const Command kEval{"eval", "distance and gradient of the scene at points: prints x,y,z,distance,gx,gy,gz,object",
                    "marchbox eval saves/welcome.txt --points points.csv --on gpu", make};

}  // namespace mb::cli
