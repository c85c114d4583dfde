#pragma once
// A run of a world that can be made again: the scene it began with, what was done to it, and what its state was after each
// step, as hashes. As text, it is read and compared by eyes and by diff:
//
//   marchbox-recording 1
//   scene                                the scene at the start; the lines of its text follow, two spaces further in
//     marchbox 1
//     …
//   step n:1 state:8531085d9046dc8e bodies:0f3c21aa,77e1b0c4
//   throw seed:1 speed:6                 done after step 1, before step 2: a row of actionKinds()
//   step n:2 state:a41b6e7094ab2f10 bodies:52a0bd17,-
//   statics                              the shapes, the world and the knobs were changed to those of this scene
//     marchbox 1
//     …
//   end
//
// `bodies` has eight digits for each body, in the order of the scene without those removed; '-' says that it is as it was
// a step before. Bodies are named by the number of their object in the scene, counted from 1, or by what `ids:1,2,7` behind
// `scene` or `statics` says of its objects. Numbers have the shortest form that reads back to the same bits.
#include "core/scene/text.h"
#include "physics/action.h"

namespace mb {

/// The state after a step.
struct StepHash {
    std::uint64_t state = 0;
    std::vector<std::uint32_t> bodies;  // of each; none where they were not kept
    friend bool operator==(const StepHash&, const StepHash&) = default;
};
StepHash hashOf(const PhysicsWorld& world);

struct Recording {
    std::shared_ptr<const Scene> start;
    std::vector<Action> actions;        // in the order they were done in
    std::vector<StepHash> steps;        // after the first, the second …
};

/// Where a run first was another than the recorded one.
struct Divergence {
    std::uint64_t step = 0;             // the first of which the state is another
    std::string body;                   // the first one that differs; empty: none does, or it is not known
    std::uint64_t recorded = 0, found = 0;  // the hashes of the state
};
/// "at step 17: body 'ball' is another (state …, recorded …)"
std::string describe(const Divergence& divergence);

/// Compares a world with what was recorded of its last step; `before` are the bodies it had after the step
/// before that.
std::optional<Divergence> compare(const Recording& recording, const PhysicsWorld& world, std::span<const ObjectId> before);

inline constexpr std::size_t kMostRecordingBytes = std::size_t{256} << 20;

struct RecordingResult {
    Recording recording;                // without a start if there is a fault
    std::vector<Fault> faults, warnings;
    std::string disk_fault;             // why the file could not be read at all, or empty
    bool ok() const { return disk_fault.empty() && faults.empty(); }
};

/// Takes time and memory in proportion to the text, whatever its bytes.
RecordingResult readRecording(std::string_view bytes);
std::string writeRecording(const Recording& recording);
/// As loadScene and saveScene do.
RecordingResult loadRecording(const std::filesystem::path& path);
std::optional<std::string> saveRecording(const std::filesystem::path& path, const Recording& recording);

}  // namespace mb
