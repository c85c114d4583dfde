// No bytes make the reader slow, deep or large.
#include "core/scene/keys.h"
#include "core/scene/text.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <functional>

#include <pthread.h>

using namespace mb;

namespace {

double seconds(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Runs the work on a stack of 256 KiB, the smallest it must do with.
void onSmallStack(std::function<void()> work) {
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    REQUIRE(pthread_attr_setstacksize(&attributes, 256 * 1024) == 0);
    pthread_t thread;
    const auto run = [](void* w) -> void* { return (*static_cast<std::function<void()>*>(w))(), nullptr; };
    REQUIRE(pthread_create(&thread, &attributes, run, &work) == 0);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
}

/// Text of n bytes and more that repeats one piece.
std::string filled(std::string_view piece, std::size_t n) {
    std::string out;
    while (out.size() < n) out += piece;
    return out;
}

/// Lines that a careless pattern or reader would choke on, each within the limit.
std::vector<std::string> worstLines() {
    std::vector<std::string> lines;
    for (const char* piece : {"1", "a", "(", " ", "\t", "\"", "\\", ":", ",", "-", "1,", "a:1 ", "a:", "\\\"", "e1", ".", "a_", "é", "#"})
        for (const char* head : {"", "world gravity:", "world background:", "material name:\"", "material name:", "object type:", "object ", "r:"})
            lines.push_back((head + filled(piece, Limits::line_bytes)).substr(0, Limits::line_bytes));
    lines.push_back("material name:\"" + filled("x", Limits::line_bytes - 16) + "\"");
    lines.push_back("material name:\"" + filled("\\\"", Limits::line_bytes - 17) + "\"");
    return lines;
}

}  // namespace

TEST_CASE("the worst lines need a small stack") {
    onSmallStack([] {
        for (const std::string& line : worstLines()) {
            (void)readScene("marchbox 1\n" + line + "\n");
            (void)readScene(line);
        }
    });
}

TEST_CASE("lines without an end, and deep ones") {
    for (const char c : {'1', ' ', '(', 'a', '"'})
        CHECK(readScene("marchbox 1\n" + std::string(10'000'000, c)).faults.at(0).column == 4097);
    std::string deep = "marchbox 1\n";
    for (std::size_t i = 0; i < 2000; ++i) deep += std::string(2 * i, ' ') + "object type:union\n";
    CHECK(!readScene(deep).ok());
}

TEST_CASE("time grows with the size and no faster") {
    const auto objects = [](std::size_t n) {
        std::string text = "marchbox 1\n";
        for (std::size_t i = 0; i < n; ++i)
            text += fmt::format("object name:object_with_a_long_name_{0} type:sphere material:m{1} pos:{0},0.1,-2e-3 radius:0.5\n", i, i % 4000);
        for (std::size_t i = 0; i < 4000; ++i) text += fmt::format("material name:m{} color:0.1,0.2,0.3\n", i);
        return text;
    };
    const auto children = [](std::size_t n) { return "marchbox 1\nobject type:union\n" + filled("  object type:sphere radius:1\n", n * 30); };
    const auto comments = [](std::size_t n) { return filled("marchbox 1\n", 1) + filled("# " + std::string(4000, '"') + "\n", n * 100); };
    const auto quotes = [](std::size_t n) {
        std::string text = "marchbox 1\n";
        for (std::size_t i = 0; i < n / 40; ++i) text += fmt::format("object type:sphere radius:1 name:\"{}{}\"\n", filled("\\\"", 4000), i);
        return text;
    };
    // A quadratic reader needs 16 times as long for four times as much.
    for (const auto& make : std::vector<std::function<std::string(std::size_t)>>{objects, children, comments, quotes}) {
        const std::string small = make(20'000), large = make(80'000);
        bool ok = true;
        const auto read = [&](const std::string& text) { return seconds([&] { ok = ok && readScene(text).ok(); }); };
        const double once = std::min({read(small), read(small), read(small)}), four = std::min(read(large), read(large));
        CHECK(ok);
        CHECK_MESSAGE(four < 10 * once + 0.05, fmt::format("{} s, {} s", once, four));
    }
}

TEST_CASE("worst faults do not take long") {
    std::string text = "marchbox 1\n";
    for (int i = 0; i < 4096; ++i) text += fmt::format("material name:{:a>100}{}\n", "", i);
    for (int i = 0; i < 90'000; ++i) text += fmt::format("object type:sphere radius:1 material:{:b>100}\n", "");
    const ReadResult r = readScene(text);
    CHECK(r.faults.size() == kMaxFaults);
    CHECK(r.faults[0].message.ends_with("…'"));
}
