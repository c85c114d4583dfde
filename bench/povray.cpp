#include "bench/povray.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <regex>

#include <unistd.h>

namespace fs = std::filesystem;

namespace mb::bench {
namespace {

std::string text(glm::dvec3 v) { return fmt::format("<{:.17g},{:.17g},{:.17g}>", v.x, v.y, v.z); }

std::string shapeText(const Solid& s) {
    switch (s.kind) {
    case Solid::Kind::sphere: return fmt::format("sphere {{ {}, {:.17g}", text(s.centre), s.half.x);
    case Solid::Kind::box: return fmt::format("box {{ {}, {}", text(s.centre - s.half), text(s.centre + s.half));
    case Solid::Kind::cylinder:
        return fmt::format("cylinder {{ {}, {}, {:.17g}", text(s.centre - glm::dvec3{0, s.half.y, 0}),
                           text(s.centre + glm::dvec3{0, s.half.y, 0}), s.half.x);
    default: return fmt::format("plane {{ y, {:.17g}", s.centre.y);
    }
}

std::string partText(const Part& part, const std::string& texture) {
    assert(part.blend == 0);
    if (part.op == Part::Op::solid) return shapeText(part.solid) + texture + " }\n";
    std::string all = part.op == Part::Op::unite ? "union {\n" : "difference {\n";
    for (const Part& child : part.parts) all += partText(child, {});
    return all + texture + " }\n";
}

/// Object number i as a colour: i + 1 in base 256.
std::string flatTexture(std::size_t i) {
    const std::size_t code = i + 1;
    return fmt::format(" pigment {{ rgb <{}/255,{}/255,{}/255> }} finish {{ ambient 1 diffuse 0 }}", code >> 16, code >> 8 & 255,
                       code & 255);
}

std::string cameraText(const Camera& camera) {
    const View view = viewOf(camera);
    const double size = 2 * view.half;
    return fmt::format("camera {{ {} location {} direction {} right {}*{:.17g}*image_width/image_height up {}*{:.17g} }}\n",
                       view.parallel ? "orthographic" : "perspective", text(camera.eye), text(view.forward), text(view.right), size,
                       text(view.up), size);
}

/// The bytes of a PPM with 8 bits a channel; empty where it is none.
std::string readPpm(const fs::path& path, glm::ivec2 size) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const std::size_t pixels = 3 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    return bytes.size() > pixels && bytes.starts_with("P6") ? bytes.substr(bytes.size() - pixels) : std::string();
}
unsigned byteOf(const std::string& bytes, std::size_t i) { return static_cast<unsigned char>(bytes[i]); }

/// The output of a command of the shell.
std::string outputOf(const std::string& command) {
    std::FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return {};
    std::string output;
    char buffer[4096];
    for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) output.append(buffer, n);
    pclose(pipe);
    return output;
}

}  // namespace

std::string povText(const Model& model, bool flat) {
    std::string all = "#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level 2 }\nbackground { rgb 0 }\n";
    all += cameraText(model.camera);
    if (!flat) all += fmt::format("light_source {{ {} rgb 1 }}\n", text(lightPosition(model)));
    for (std::size_t i = 0; i < materials().size(); ++i)
        all += fmt::format("#declare M{} = texture {{ pigment {{ rgb {} }} finish {{ ambient {} diffuse {} phong {} phong_size {} "
                           "reflection {} }} }}\n",
                           i, text(materials()[i].color), kAmbient, kDiffuse, kSpecular, kShininess, kReflected);
    for (std::size_t i = 0; i < model.objects.size(); ++i)
        all += partText(model.objects[i], flat ? flatTexture(i) : fmt::format(" texture {{ M{} }}", model.objects[i].material));
    return all;
}

bool readPovTimes(const std::string& output, PovTimes& times) {
    static const std::regex kTrace(R"(Trace Time:[^(\n]{0,200}\(([0-9.]{1,20}) seconds\)\s{1,80})"
                                   R"(using [0-9]{1,4} thread\(s\) with ([0-9.]{1,20}) CPU-seconds)");
    static const std::regex kVersion(R"(Version ([0-9][0-9.]{1,20}[0-9]))");
    std::smatch found;
    const std::size_t from = output.rfind("Trace Time:");
    if (from == std::string::npos) return false;
    const std::string tail = output.substr(from, 400), head = output.substr(0, 400);
    if (!std::regex_search(tail, found, kTrace)) return false;
    times.trace_ms = 1000 * std::strtod(found.str(1).c_str(), nullptr);
    times.cpu_ms = 1000 * std::strtod(found.str(2).c_str(), nullptr);
    if (std::regex_search(head, found, kVersion)) times.version = found[1];
    return true;
}

Povray::Povray(const Model& model, glm::ivec2 size) : size_(size) {
    static int made = 0;
    folder_ = fs::temp_directory_path() / fmt::format("marchbox_bench_{}_{}", getpid(), made++);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "lit.pov") << povText(model, false);
    std::ofstream(folder_ / "flat.pov") << povText(model, true);
}

Povray::~Povray() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

bool Povray::available() { return std::system("command -v povray >/dev/null 2>&1") == 0; }

std::string Povray::run(const char* name, PovTimes& times) {
    // The folder's name goes through the environment, so that the shell reads nothing of it.
    setenv("MARCHBOX_BENCH_FOLDER", folder_.c_str(), 1);
    const std::string output = outputOf(fmt::format(
        "cd \"$MARCHBOX_BENCH_FOLDER\" && povray +I{0}.pov +O{0}.ppm +FP File_Gamma=1.0 +W{1} +H{2} -D -A +Q9 +WT2 -V 2>&1", name, size_.x, size_.y));
    if (readPovTimes(output, times)) return {};
    constexpr std::size_t kEnough = 300;
    return "POV-Ray printed no trace time: " + output.substr(output.size() - std::min(output.size(), kEnough));
}

std::string Povray::draw(PovTimes& times) { return run("lit", times); }

std::vector<glm::vec3> Povray::picture() const {
    const std::string bytes = readPpm(folder_ / "lit.ppm", size_);
    std::vector<glm::vec3> colors;
    for (std::size_t i = 0; i < bytes.size(); i += 3)
        colors.push_back(glm::vec3{byteOf(bytes, i), byteOf(bytes, i + 1), byteOf(bytes, i + 2)} / 255.0f);
    return colors;
}

std::string Povray::objects(std::vector<float>& numbers) {
    PovTimes times;
    if (std::string why = run("flat", times); !why.empty()) return why;
    const std::string bytes = readPpm(folder_ / "flat.ppm", size_);
    if (bytes.empty()) return "POV-Ray wrote no picture";
    numbers.clear();
    for (std::size_t i = 0; i < bytes.size(); i += 3)
        numbers.push_back(static_cast<float>(byteOf(bytes, i) << 16 | byteOf(bytes, i + 1) << 8 | byteOf(bytes, i + 2)) - 1.0f);
    return {};
}

}  // namespace mb::bench
