// Files: what can stand at a path, and saves that are whole or not at all.
#include "core/scene/keys.h"
#include "core/scene/text.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace mb;
namespace fs = std::filesystem;

namespace {

/// A folder of its own for one test, gone afterwards.
struct Folder {
    fs::path path;
    Folder() {
        std::string name = (fs::temp_directory_path() / "marchbox-test-XXXXXX").string();
        REQUIRE(::mkdtemp(name.data()) != nullptr);
        path = name;
    }
    ~Folder() {
        std::error_code ignored;
        fs::permissions(path, fs::perms::owner_all, ignored);
        fs::remove_all(path, ignored);
    }
    fs::path operator/(const fs::path& name) const { return path / name; }
    std::size_t entries() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), {})); }
};

std::string contents(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}
void put(const fs::path& path, std::string_view text) { std::ofstream(path, std::ios::binary) << text; }

/// A scene of n spheres, told apart by their radius.
Scene spheres(std::size_t n, double radius) {
    Scene s;
    for (std::size_t i = 0; i < n; ++i) {
        Object& o = s.objects.emplace_back();
        o.id = s.newId(), o.type = findShapeType("sphere"), o.numbers = initialNumbers(*o.type), o.numbers[0] = radius;
    }
    return s;
}
mode_t modeOf(const fs::path& path) {
    struct stat info{};
    REQUIRE(::stat(path.c_str(), &info) == 0);
    return info.st_mode & 07777;
}

}  // namespace

TEST_CASE("a saved scene loads again") {
    const Folder folder;
    const fs::path path = folder / "a scene.txt";
    CHECK(!saveScene(path, spheres(3, 2)));
    const LoadResult r = loadScene(path);
    CHECK(r.ok());
    CHECK(sameScene(r.scene, spheres(3, 2)));
    CHECK(!saveScene(path, spheres(1, 1)));
    CHECK(contents(path) == writeScene(spheres(1, 1)));
    CHECK(folder.entries() == 1);
    CHECK(!saveScene(folder / (std::string(251, 'x') + ".txt"), spheres(1, 1)));
}

TEST_CASE("a save in the folder one stands in") {
    const Folder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path);
    CHECK(!saveScene("here.txt", spheres(1, 1)));
    CHECK(loadScene("here.txt").ok());
    fs::current_path(before);
}

TEST_CASE("what cannot be read is told, and nothing waits") {
    const Folder folder;
    const auto told = [](const fs::path& path) {
        const LoadResult r = loadScene(path);
        CHECK(!r.ok());
        CHECK(r.faults.empty());
        return r.disk_fault;
    };
    CHECK(told(folder / "none") == (folder / "none").string() + ": cannot read: No such file or directory");
    CHECK(told(folder.path) == folder.path.string() + ": cannot read: it is a folder, expected a file");
    CHECK(told("/dev/zero") == "/dev/zero: cannot read: it is a device, expected a file");
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    CHECK(told(folder / "pipe").ends_with("it is a pipe, expected a file"));
    fs::create_symlink("loop", folder / "loop");
    CHECK(told(folder / "loop").ends_with("Too many levels of symbolic links"));
    put(folder / "secret", "marchbox 1\n");
    fs::permissions(folder / "secret", fs::perms::none);
    if (::geteuid() != 0) CHECK(told(folder / "secret").ends_with("Permission denied"));

    put(folder / "bad", "marchbox 1\nlight\n");
    const LoadResult bad = loadScene(folder / "bad");
    CHECK(bad.disk_fault.empty());
    CHECK(bad.faults.size() == 1);
    put(folder / "large", "marchbox 1\n");
    fs::resize_file(folder / "large", std::uintmax_t{1} << 34);  // sparse
    const LoadResult large = loadScene(folder / "large");
    CHECK(large.disk_fault.empty());
    CHECK(large.faults.at(0).message == "the file has 17179869184 bytes, expected at most 67108864 (64 MiB)");
}

TEST_CASE("a save keeps permissions and links") {
    const Folder folder;
    put(folder / "file", "old");
    REQUIRE(::chmod((folder / "file").c_str(), 0640) == 0);
    fs::create_symlink("file", folder / "link");
    fs::create_directory(folder / "sub");
    fs::create_symlink("../link", folder / "sub/far");
    CHECK(!saveScene(folder / "sub/far", spheres(1, 1)));
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(fs::is_symlink(folder / "sub/far"));
    CHECK(contents(folder / "file") == writeScene(spheres(1, 1)));
    CHECK(modeOf(folder / "file") == 0640);
    fs::create_symlink(folder / "new", folder / "dangling");
    CHECK(!saveScene(folder / "dangling", spheres(1, 1)));
    CHECK(loadScene(folder / "new").ok());
    const mode_t mask = ::umask(027);
    CHECK(!saveScene(folder / "masked", spheres(1, 1)));
    ::umask(mask);
    CHECK(modeOf(folder / "masked") == 0640);
    fs::create_symlink("loop", folder / "loop");
    CHECK(saveScene(folder / "loop", spheres(1, 1))->ends_with("Too many levels of symbolic links"));
}

TEST_CASE("a save that cannot be says why and leaves the old file") {
    const Folder folder;
    CHECK(saveScene(folder / "none/file", spheres(1, 1))->ends_with("No such file or directory"));
    CHECK(saveScene(folder.path, spheres(1, 1))->ends_with("it is a folder, expected a file"));
    CHECK(*saveScene("/dev/full", spheres(1, 1)) == "/dev/full: cannot write: it is a device, expected a file");
    put(folder / "file", "old");
    CHECK(saveScene(folder / "file/file", spheres(1, 1))->ends_with("Not a directory"));

    Scene wrong = spheres(1, -1);
    CHECK(saveScene(folder / "file", wrong)->ends_with(": not saved: 'radius' is -1, expected a number from 1e-6 to 1e6"));
    wrong.objects[0].numbers[0] = std::nan("");
    CHECK(saveScene(folder / "file", wrong)->find("'nan'") != std::string::npos);
    CHECK(contents(folder / "file") == "old");
    CHECK(folder.entries() == 1);

    if (::geteuid() != 0) {
        fs::permissions(folder / "file", fs::perms::owner_read);
        CHECK(saveScene(folder / "file", spheres(1, 1))->ends_with("Permission denied"));
        fs::permissions(folder / "file", fs::perms::owner_read | fs::perms::owner_write);
        fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
        CHECK(saveScene(folder / "file", spheres(1, 1))->ends_with("Permission denied"));
        CHECK(contents(folder / "file") == "old");
    }
}

TEST_CASE("no space: the old file stays, and nothing beside it") {
    const Folder folder;
    CHECK(!saveScene(folder / "file", spheres(10, 1)));
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    rlimit small = before;
    small.rlim_cur = 4096;
    ::setrlimit(RLIMIT_FSIZE, &small);
    const std::optional<std::string> failed = saveScene(folder / "file", spheres(1000, 2));
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_DFL);
    REQUIRE(failed);
    CHECK(failed->ends_with("cannot write: File too large"));
    CHECK(contents(folder / "file") == writeScene(spheres(10, 1)));
    CHECK(folder.entries() == 1);
}

TEST_CASE("a save killed at any moment leaves one whole file, and the next one clears up") {
    const Folder folder;
    const fs::path path = folder / "file";
    const Scene a = spheres(2000, 1), b = spheres(3000, 2);
    const std::string text_a = writeScene(a), text_b = writeScene(b);
    CHECK(!saveScene(path, a));
    std::mt19937 random(1);
    for (int i = 0; i < 100; ++i) {
        const pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0)
            for (int n = 0;; ++n)
                if (saveScene(path, n % 2 == 0 ? b : a)) ::_exit(1);
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 30'000));
        ::kill(child, SIGKILL);
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        CHECK(WIFSIGNALED(status));
        const std::string now = contents(path);
        REQUIRE((now == text_a || now == text_b));
        CHECK(folder.entries() <= 2);
    }
    CHECK(!saveScene(path, a));
    CHECK(folder.entries() == 1);
}

TEST_CASE("saves of one file at once: each is whole") {
    const Folder folder;
    const fs::path path = folder / "file";
    CHECK(!saveScene(path, spheres(100, 1)));
    int failures = 0;
    std::vector<std::thread> savers;
    std::vector<std::optional<std::string>> said(4);
    for (std::size_t t = 0; t < said.size(); ++t)
        savers.emplace_back([&, t] {
            for (int i = 0; i < 50 && !said[t]; ++i) said[t] = saveScene(path, spheres(100 * (t + 1), 1));
        });
    for (int i = 0; i < 200; ++i) failures += !loadScene(path).ok();
    for (std::thread& saver : savers) saver.join();
    CHECK(failures == 0);
    for (const auto& s : said) CHECK_MESSAGE(!s, s.value_or(""));
    CHECK(folder.entries() == 1);
}
