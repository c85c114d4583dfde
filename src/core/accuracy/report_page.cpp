// The page that explains a sweep.
#include "core/accuracy/report.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {
namespace {

constexpr std::string_view kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>
body{font-family:sans-serif;max-width:1480px;margin:2em auto;padding:0 1em;color:#111827;line-height:1.45}
h1{font-size:1.6em}h2{font-size:1.25em;margin-top:2.2em;border-top:1px solid #d1d5db;padding-top:1em}
p{max-width:60em}img.chart{max-width:100%;height:auto}
.shots{display:flex;flex-wrap:wrap;gap:1em}.shots figure{margin:0}.shots img{width:320px;image-rendering:pixelated;display:block}
figcaption{font-size:.85em;color:#374151;max-width:320px}
table{border-collapse:collapse}td,th{text-align:left;padding:.2em .8em;border-bottom:1px solid #e5e7eb;vertical-align:top}
.says{background:#f3f4f6;padding:.6em .9em}
</style>
)";

std::string paragraph(std::string_view text, std::string_view kind = {}) { return fmt::format("<p{}>{}</p>\n", kind, escaped(text)); }
std::string chart(const std::string& file, std::string_view what) { return fmt::format("<p><img class=\"chart\" src=\"{}\" alt=\"{}\"></p>\n", escaped(file), escaped(what)); }

std::string meanings(const Page& page) {
    bool pictures = false, motions = false;
    for (const auto& [sweep, chart_name] : page.overviews) (sweep->motion ? motions : pictures) = true;
    std::string out = "<table>\n<tr><th>name</th><th>unit</th><th>what it is</th></tr>\n";
    const auto add = [&](const auto& row) {
        if (row.motion ? motions : pictures) out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", row.name, escaped(row.unit), escaped(row.meaning));
    };
    for (const auto& row : errorRows()) add(row);
    for (const auto& row : costRows()) add(row);
    return out + "</table>\n";
}

std::string shots(const KnobSection& section) {
    std::string out;
    for (const Shots::Shot& s : section.shots.shots)
        out += fmt::format("<figure><img src=\"{}\" alt=\"the picture\"><img src=\"{}\" alt=\"where it is wrong\"><figcaption>{}</figcaption></figure>\n", escaped(s.picture), escaped(s.error_map), escaped(s.caption));
    return out.empty() ? out : fmt::format("<div class=\"shots\">\n{}</div>\n", out);
}

/// The settings that are no points, each with its reason.
std::string failures(const Page& page) {
    std::string rows;
    for (const auto& [sweep, chart_name] : page.overviews)
        for (const Run& run : sweep->runs)
            if (run.failed()) {
                const std::string set = differences(run.setting, sweep->runs[kOwnRun].setting);
                rows += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(set.empty() ? "the scene's own setting" : set), escaped(run.failure));
            }
    if (rows.empty()) return paragraph("No setting failed.");
    return paragraph("These gave no picture or motion that counts, and stand in no chart.") + "<table>\n<tr><th>set</th><th>why it failed</th></tr>\n" + rows + "</table>\n";
}

std::string frontTable(const Sweep& sweep) {
    std::string out = "<details><summary>The settings that nothing beats</summary>\n<table>\n<tr><th>set</th>";
    for (const Error e : sweep.terms.errors) out += fmt::format("<th>{}</th>", rowOf(e).name);
    out += fmt::format("<th>{} {}</th></tr>\n", rowOf(sweep.terms.cost).name, rowOf(sweep.terms.cost).unit);
    std::vector<std::size_t> front = distinct(sweep.runs, unbeaten(sweep.runs, sweep.terms), sweep.terms);
    std::ranges::sort(front, {}, [&](std::size_t i) { return sweep.runs[i].costs[sweep.terms.cost]; });
    for (const std::size_t i : front) {
        const Run& run = sweep.runs[i];
        const std::string set = differences(run.setting, sweep.runs[kOwnRun].setting);
        out += fmt::format("<tr><td>{}</td>", escaped(set.empty() ? "as it is" : set));
        for (const Error e : sweep.terms.errors) out += fmt::format("<td>{}</td>", run.errors.has(e) ? brief(run.errors[e]) : "");
        out += fmt::format("<td>{}</td></tr>\n", brief(run.costs[sweep.terms.cost]));
    }
    return out + "</table></details>\n";
}

}  // namespace

std::string reportHtml(const Page& page) {
    std::string out = fmt::format("{}<title>What accuracy costs in {}</title></head><body>\n<h1>What accuracy costs in {}</h1>\n", kHead, escaped(page.scene), escaped(page.scene));
    out += paragraph("Every picture and every motion here is a little wrong, and being less wrong takes time. Each chart shows how wrong (left is better) and how much work (down is better): "
                     "a point at the lower left is both right and cheap. Both axes are stretched: the same way along one is always the same number of times as much.");
    out += paragraph("Under a chart stand pictures at three settings, each with its map of errors: grey where nothing is wrong, over yellow to red the more the color is off, blue where another surface shows "
                     "than should, magenta where a ray had no answer. The maps of rays a pixel and of the size compare the whole pixel's color, all others its middle's; those of a motion compare with the true motion's picture.");
    out += paragraph(fmt::format("Pictures: {}. Drawn by {}. Work is counted, not timed, wherever it can be: counts are the same on every machine.", page.size, page.renderer));
    for (const auto& [sweep, file] : page.overviews) {
        out += fmt::format("<h2>{}</h2>\n", sweep->motion ? "All knobs of the motion together" : "All knobs of the picture together");
        out += chart(file, "overview");
        if (!sweep->motion && !page.front.empty()) out += fmt::format("<p><a href=\"{}\">The first of these charts alone.</a></p>\n", escaped(page.front));
        out += paragraph(frontSays(*sweep), " class=\"says\"") + paragraph(fmt::format("Held against: {}", sweep->reference)) + frontTable(*sweep);
    }
    for (const KnobSection& section : page.knobs) {
        out += fmt::format("<h2>{} <small>({})</small></h2>\n", escaped(section.knob->title), section.knob->key);
        out += paragraph(section.knob->meaning) + chart(section.chart, section.knob->key) + paragraph(knobSays(*section.sweep, *section.knob), " class=\"says\"") + shots(section);
    }
    out += "<h2>What failed</h2>\n" + failures(page);
    out += "<h2>What the words mean</h2>\n" + meanings(page);
    return out + "</body></html>\n";
}

}  // namespace mb
