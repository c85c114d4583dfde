#pragma once
// What is said of a sweep: a table of all runs, charts, and a page that explains them to anybody. Text only: the pictures that the
// page shows are the caller's to write.
#include "core/accuracy/chart.h"
#include "core/accuracy/front.h"
#include "core/accuracy/knobs.h"

namespace mb {

/// The runs of a sweep of pictures or of motions.
struct Sweep {
    std::vector<Run> runs;
    Terms terms;
    bool motion = false;
    std::string reference;               // what the truth was, and how far it may be off itself
    std::optional<Setting> stands = {};  // what the charts mark as the scene's own, and tips tell differences from; none: the own run's
};

/// One row a run: knob, value, what differs from the scene's own setting, each error, each cost, undecided, status, reason. Motions
/// behind pictures. A field that was not measured is empty.
std::string runsCsv(std::span<const Sweep> sweeps);

/// A knob's charts: each error that it moves over what it costs. And those of all runs together: the line of each error, and where
/// the own setting stands.
std::vector<ChartPanel> knobPanels(const Sweep& sweep, const Knob& knob);
std::vector<ChartPanel> overviewPanels(const Sweep& sweep);

/// What the runs of one knob say, in a sentence; and what the joint runs say of the own setting.
std::string knobSays(const Sweep& sweep, const Knob& knob);
std::string frontSays(const Sweep& sweep);

/// Three pictures of a knob: the files' names, of the picture and of its errors, and what the knob was at.
struct Shots {
    struct Shot {
        std::string picture, error_map, caption;
    };
    std::vector<Shot> shots;
};
/// A section of the page: one knob's chart and what it shows.
struct KnobSection {
    const Knob* knob = nullptr;
    const Sweep* sweep = nullptr;
    std::string chart;                   // a file's name
    Shots shots;
};
struct Page {
    std::string scene, renderer, size;   // as the reader is to see them
    std::vector<std::pair<const Sweep*, std::string>> overviews;  // with their charts' names
    std::vector<KnobSection> knobs;
    std::string front = {};              // the color's chart alone: a file's name; empty: there is none
};
std::string reportHtml(const Page& page);

}  // namespace mb
