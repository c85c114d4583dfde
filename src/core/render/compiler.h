#pragma once
// Compiles programs on a thread of its own, in a context that shares its objects with the one that draws.
//
// Linking is the smaller part: software OpenGL makes the machine code at a program's first draw, for the context that draws.
// So a linked program also draws a few pixels here, with the state the renderer draws with. The other context then finds the
// code in Mesa's cache of shaders on the disk: saves/welcome.txt's first draw takes it 10 ms, and 400 where that cache is
// switched off (MESA_SHADER_CACHE_DISABLE) and the code is made again.
#include "core/render/context.h"
#include "core/render/program.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace mb {

class Compiler {
public:
    /// A program's text, and what it will draw into and read.
    struct Job {
        Composed text;
        int attachments = 0;
        bool adds = false;  // draws into a picture that adds its passes up
        bool grid = false;  // reads a grid's buffers
    };
    struct Done {
        std::string text;
        Program program;
    };
    /// How many programs it holds at most: the one in work, or the one that nobody has taken yet.
    static constexpr std::size_t kHeld = 1;

    /// A thread that compiles for `drawing`, which is current here and stays so. Null with the reason in `why`.
    static std::unique_ptr<Compiler> start(Context& drawing, std::string& why);
    /// Waits for the program in work. The context that draws must be current.
    ~Compiler();
    Compiler(const Compiler&) = delete;
    Compiler& operator=(const Compiler&) = delete;

    /// Compiles that next, unless it is in work or done. Nothing else waits any longer: what was asked for before is not wanted now.
    void want(Job job);
    /// A program that is ready, good or not; each is given out once, and the next is begun when it is.
    std::optional<Done> take();
    std::size_t waiting() const;

private:
    explicit Compiler(std::unique_ptr<Context> context) : context_(std::move(context)) {}
    void run(std::string& why);
    void work();

    std::unique_ptr<Context> context_;
    mutable std::mutex mutex_;  // guards what follows
    std::condition_variable changed_;
    std::optional<Job> waiting_;
    std::string in_work_;       // its text; empty: none
    std::optional<Done> done_;
    bool started_ = false, ends_ = false;
    std::thread thread_;
};

}  // namespace mb
