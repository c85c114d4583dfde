#include "core/render/compiler.h"

#include "core/render/grid_buffers.h"
#include "core/render/targets.h"

#include <array>

namespace mb {
namespace {

constexpr int kSide = 8;  // pixels of the picture that a program is tried on

/// What programs are tried on. Every number they read is 0: no step is made, no ray is sent on.
class Trial {
public:
    Trial() {
        static constexpr std::array<char, 1 << 16> kZeros{};
        GLuint name = 0;
        glGenBuffers(1, &name);
        zeros_ = OwnedBuffer(name);
        glBindBuffer(GL_UNIFORM_BUFFER, zeros_);
        glBufferData(GL_UNIFORM_BUFFER, kZeros.size(), kZeros.data(), GL_STATIC_DRAW);
        for (GLuint point = 0; point < static_cast<GLuint>(BlockPoint::count); ++point) glBindBufferBase(GL_UNIFORM_BUFFER, point, zeros_);
        Grid none;
        grid_.upload(none, {});
    }
    void draw(const Program& program, const Compiler::Job& job) {
        const Targets picture({kSide, kSide}, job.attachments);
        glUseProgram(program.name);
        if (job.grid) grid_.bind(program);
        picture.clear();
        std::optional<AddingUp> adding;
        if (job.adds) adding.emplace();
        quad_.draw();
        gl.Finish();
        glUseProgram(0);
    }

private:
    OwnedBuffer zeros_;
    GridBuffers grid_;
    Quad quad_;
};

}  // namespace

std::unique_ptr<Compiler> Compiler::start(Context& drawing, std::string& why) {
    auto context = drawing.makeShared(why);
    if (!context) return nullptr;
    std::unique_ptr<Compiler> compiler(new Compiler(std::move(context)));
    compiler->thread_ = std::thread([&c = *compiler, &why] { c.run(why); });
    std::unique_lock lock(compiler->mutex_);
    compiler->changed_.wait(lock, [&] { return compiler->started_; });
    lock.unlock();
    return why.empty() ? std::move(compiler) : nullptr;
}

Compiler::~Compiler() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void Compiler::want(Job job) {
    const std::lock_guard lock(mutex_);
    waiting_.reset();
    if (job.text.text == in_work_ || (done_ && job.text.text == done_->text)) return;
    waiting_ = std::move(job);
    changed_.notify_all();
}

std::optional<Compiler::Done> Compiler::take() {
    const std::lock_guard lock(mutex_);
    std::optional<Done> done = std::move(done_);
    done_.reset();
    changed_.notify_all();
    return done;
}

std::size_t Compiler::waiting() const {
    const std::lock_guard lock(mutex_);
    return waiting_ ? 1 : 0;
}

void Compiler::run(std::string& why) {
    const std::string refused = context_->makeCurrent();
    {
        const std::lock_guard lock(mutex_);
        why = refused, started_ = true;
    }
    changed_.notify_all();
    if (!refused.empty()) return;
    work();
    context_->release();
}

void Compiler::work() {
    Trial trial;
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return ends_ || (waiting_ && !done_); });
        if (ends_) return;
        const Job job = std::move(*waiting_);
        waiting_.reset(), in_work_ = job.text.text;
        lock.unlock();
        Program program = makeProgram(job.text);
        if (program.usable()) trial.draw(program, job);
        lock.lock();
        done_ = {std::move(in_work_), std::move(program)};
        in_work_.clear();
    }
}

}  // namespace mb
