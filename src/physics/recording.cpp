#include "physics/recording.h"

#include "core/scene/file.h"
#include "core/scene/text_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace mb {
namespace {

void appendScene(std::string& out, std::string_view keyword, const Scene& scene) {
    out += keyword;
    bool counted = true;  // the ids are 1, 2, 3 …
    for (std::size_t i = 0; i < scene.objects.size(); ++i) counted &= scene.objects[i].id.value == i + 1;
    for (std::size_t i = 0; i < scene.objects.size() && !counted; ++i)
        fmt::format_to(std::back_inserter(out), "{}{}", i == 0 ? " ids:" : ",", scene.objects[i].id.value);
    out += '\n';
    const std::string text = writeScene(scene);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at) + 1;
        out.append("  ").append(text, at, end - at);
        at = end;
    }
}

struct ArgumentText {
    const Action& action;
    std::string operator()(ObjectId Action::*m) const { return fmt::format("{}", (action.*m).value); }
    std::string operator()(std::uint64_t Action::*m) const { return fmt::format("{}", action.*m); }
    std::string operator()(double Action::*m) const { return text::valueText(action.*m); }
    std::string operator()(glm::dvec3 Action::*m) const { return text::valueText(action.*m); }
};

void appendAction(std::string& out, const Action& action) {
    if (action.kind->has_scene) return appendScene(out, action.kind->name, *action.scene);
    out += action.kind->name;
    for (const Argument& a : action.kind->arguments)
        out.append(" ").append(a.name).append(":").append(std::visit(ArgumentText{action}, a.member));
    out += '\n';
}

void appendStep(std::string& out, std::size_t n, const StepHash& step, const StepHash* before) {
    fmt::format_to(std::back_inserter(out), "step n:{} state:{:016x}", n, step.state);
    for (std::size_t i = 0; i < step.bodies.size(); ++i) {
        out += i == 0 ? " bodies:" : ",";
        if (before && i < before->bodies.size() && before->bodies[i] == step.bodies[i]) out += '-';
        else fmt::format_to(std::back_inserter(out), "{:08x}", step.bodies[i]);
    }
    out += '\n';
}

/// What to call a body of a recording.
std::string nameOf(const Recording& recording, ObjectId body) {
    const auto object = findObject(*recording.start, body);
    return object ? label(*recording.start, *object) : fmt::format("object {}", body.value);
}

/// The first body that is not as recorded, of those there were before the step; null: each is, or nothing was kept of them.
ObjectId firstOther(std::span<const std::uint32_t> recorded, std::span<const std::uint32_t> found, const PhysicsWorld& world,
                    std::span<const ObjectId> before) {
    if (recorded.empty() && !found.empty()) return {};
    const auto at = static_cast<std::size_t>(std::ranges::mismatch(recorded, found).in1 - recorded.begin());
    if (at == recorded.size() && at == found.size()) return {};
    if (found.size() >= recorded.size()) return world.bodies()[at].object;
    // A body was removed in this run alone: the first one missing behind the last that is as recorded.
    const std::span<const Body> left = world.bodies().subspan(at);
    auto body = at == 0 ? before.begin() : std::ranges::find(before, world.bodies()[at - 1].object) + 1;
    for (; body != before.end(); ++body)
        if (std::ranges::find(left, *body, &Body::object) == left.end()) return *body;
    return {};
}

}  // namespace

StepHash hashOf(const PhysicsWorld& world) {
    StepHash hash{world.stateHash(), {}};
    hash.bodies.reserve(world.bodies().size());
    for (std::size_t i = 0; i < world.bodies().size(); ++i) {
        const std::uint64_t h = world.bodyHash(i);
        hash.bodies.push_back(static_cast<std::uint32_t>(h ^ (h >> 32)));
    }
    return hash;
}

std::optional<Divergence> compare(const Recording& recording, const PhysicsWorld& world, std::span<const ObjectId> before) {
    const StepHash& recorded = recording.steps[world.steps() - 1];
    const StepHash found = hashOf(world);
    const ObjectId body = firstOther(recorded.bodies, found.bodies, world, before);
    const bool as_many = recorded.bodies.empty() || recorded.bodies.size() == found.bodies.size();
    if (recorded.state == found.state && !body && as_many) return {};
    return Divergence{world.steps(), body ? nameOf(recording, body) : std::string{}, recorded.state, found.state};
}

std::string describe(const Divergence& d) {
    if (d.body.empty() && d.found == d.recorded)
        return fmt::format("at step {}: the recording has hashes of another number of bodies; the whole state is the same", d.step);
    const std::string what = d.body.empty() ? "the state is another, and no body is known to be" : fmt::format("body '{}' is another", d.body);
    if (d.found == d.recorded) return fmt::format("at step {}: {}, by the hash of it that was recorded; that of the whole state is the same", d.step, what);
    return fmt::format("at step {}: {} (state {:016x}, recorded {:016x})", d.step, what, d.found, d.recorded);
}

std::string writeRecording(const Recording& recording) {
    std::string out = "marchbox-recording 1\n";
    appendScene(out, "scene", *recording.start);
    std::size_t done = 0;
    for (std::size_t n = 0; n <= recording.steps.size(); ++n) {
        if (n > 0) appendStep(out, n, recording.steps[n - 1], n > 1 ? &recording.steps[n - 2] : nullptr);
        for (; done < recording.actions.size() && recording.actions[done].step <= n; ++done) appendAction(out, recording.actions[done]);
    }
    return out + "end\n";
}

std::optional<std::string> saveRecording(const std::filesystem::path& path, const Recording& recording) {
    const auto refused = [&](const Scene& scene) -> std::optional<std::string> {
        const ReadResult back = readScene(writeScene(scene));
        if (back.ok()) return {};
        return fmt::format("{}: not saved: {}", path.string(), back.faults.front().message);
    };
    if (const auto why = refused(*recording.start)) return why;
    for (const Action& action : recording.actions)
        if (action.scene)
            if (const auto why = refused(*action.scene)) return why;
    const std::string text = writeRecording(recording);
    if (text.size() > kMostRecordingBytes)
        return fmt::format("{}: not saved: it would have {} bytes, more than a recording may, {}", path.string(), text.size(),
                           kMostRecordingBytes);
    return writeFile(path, text);
}

RecordingResult loadRecording(const std::filesystem::path& path) {
    FileText file = readFile(path, kMostRecordingBytes);
    RecordingResult result;
    if (!file.disk_fault.empty()) result.disk_fault = std::move(file.disk_fault);
    else if (!file.fault.empty()) result.faults.push_back({1, 1, std::move(file.fault)});
    else result = readRecording(file.bytes);
    return result;
}

}  // namespace mb
