// Charts, tables and pages: well-formed for any text, and with every run in its place.
#include "core/accuracy/report.h"
#include "made_runs.h"
#include "markup.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace mb;

namespace {

const std::string kHostile = "a <b> & \"c\" 'd' ]]> &amp; <!-- \n\x01\x7f </svg></p><script>alert(1)</script>, é";

/// A sweep as the program makes it: own, default, one knob's values, then joint ones.
Sweep sweepOf(Draw& draw, int joint, bool all_fail) {
    Sweep sweep;
    sweep.terms = pictureTerms();
    sweep.reference = kHostile;
    const Knob& knob = knobNamed("march_epsilon");
    std::vector<Run> runs = drawRuns(draw, 2 + static_cast<int>(knob.values.size()) + joint, 8);
    for (std::size_t i = 0; i < knob.values.size(); ++i) {
        Run& run = runs[2 + i];
        run.knob = knob.key, run.value = knob.values[i], run.setting = turned({}, knob, knob.values[i]);
    }
    for (std::size_t i = 2 + knob.values.size(); i < runs.size(); ++i) runs[i].setting = turned(turned({}, knob, 0.01), knobNamed("samples"), 2.0 + static_cast<double>(i));
    for (Run& run : runs)
        if (all_fail || run.failed()) run.failure = "failed, because \"" + kHostile + "\"";
    sweep.runs = runs;
    return sweep;
}

/// A table read back: rows of fields.
std::vector<std::vector<std::string>> readCsv(const std::string& text) {
    std::vector<std::vector<std::string>> rows{{""}};
    bool quotes = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quotes) {
            if (c != '"') rows.back().back() += c;
            else if (i + 1 < text.size() && text[i + 1] == '"') rows.back().back() += c, ++i;
            else quotes = false;
        } else if (c == '"') quotes = true;
        else if (c == ',') rows.back().emplace_back();
        else if (c == '\n') rows.push_back({""});
        else rows.back().back() += c;
    }
    CHECK(!quotes);
    CHECK(rows.back() == std::vector<std::string>{""});
    rows.pop_back();
    return rows;
}

}  // namespace

TEST_CASE("chart: an axis holds what it shows and little more; places rise with values") {
    Draw draw(streamOf("axes"));
    for (int round = 0; round < times(500); ++round) {
        std::vector<double> values;
        for (int i = draw.below(8); i >= 0; --i) values.push_back(draw.oneIn(5) ? 0 : draw.oneIn(4) ? std::pow(10.0, draw.below(12) - 6) : std::pow(10.0, draw.uniform(-12, 8)));
        const Axis d = axisOf(values);
        REQUIRE(d.lines.size() >= 2);
        CHECK(std::ranges::is_sorted(d.lines));
        CHECK(d.zero == (std::ranges::count(values, 0.0) > 0));
        std::ranges::sort(values);
        double before = -1, value_before = -1;
        for (const double v : values) {
            const double at = placeOn(d, v, kZeroColumn);
            CHECK(at >= -1e-9);
            CHECK(at <= 1 + 1e-9);
            if (v == 0) CHECK(at == 0);
            else if (d.zero) CHECK(at >= kZeroColumn - 1e-9);
            if (v > value_before * (1 + 1e-9)) CHECK(at > before);
            before = at, value_before = v;
        }
        const double widest = values.back();
        const auto first = std::ranges::find_if(values, [](double v) { return v > 0; });
        if (widest > 0) {
            // The values lie within the lines, and no stretch between two lines is empty at either end.
            CHECK(d.lines.back() >= widest * (1 - 1e-6));
            CHECK(d.lines.front() <= *first * (1 + 1e-6));
            if (d.lines.size() > 2) {
                CHECK(d.lines[d.lines.size() - 2] <= widest * (1 + 1e-6));
                CHECK(d.lines[1] >= *first * (1 - 1e-6));
            }
        }
        // Ten times as much takes the same room everywhere.
        const double begin = d.lines.front(), room = placeOn(d, 100 * begin, kZeroColumn) - placeOn(d, 10 * begin, kZeroColumn);
        CHECK(room == doctest::Approx((d.zero ? 1 - kZeroColumn : 1) / std::log10(d.lines.back() / begin)));
    }
    CHECK(axisOf({}).lines.size() == 2);
    CHECK(axisOf({0, 0}).zero);
    CHECK(axisOf({1}).lines == std::vector<double>{0.5, 1});
    CHECK(axisOf({30, 45}).lines == std::vector<double>{20, 50});
    CHECK(axisOf({1, 1000}).lines == std::vector<double>{1, 10, 100, 1000});
}

TEST_CASE("chart: SVG is XML whatever the texts, and shows each point once") {
    Draw draw(streamOf("svg"));
    for (int round = 0; round < 30; ++round) {
        std::vector<ChartPanel> panels;
        std::size_t points = 0;
        for (int p = draw.below(4); p > 0; --p) {
            ChartPanel panel{kHostile, kHostile, kHostile, {}};
            for (int s = draw.below(5); s > 0; --s) {
                using enum ChartSeries::Look;
                constexpr ChartSeries::Look kLooks[] = {line, faint_dots, own, usual, better};
                ChartSeries series{kLooks[static_cast<std::size_t>(draw.below(5))], draw.oneIn(3) ? "" : kHostile, {}};
                for (int i = draw.below(6); i > 0; --i, ++points) series.points.push_back({draw.oneIn(4) ? 0 : draw.logUniform(1e-9, 1e3), draw.oneIn(9) ? 0 : draw.logUniform(1, 1e6), kHostile, draw.oneIn(2) ? "" : kHostile});
                panel.series.push_back(series);
            }
            panels.push_back(panel);
        }
        const std::string svg = chartSvg(panels);
        const Markup read = readXml(svg);
        CHECK_MESSAGE(read.fault.empty(), read.fault);
        CHECK(read.elements.at("svg") == 1);
        CHECK(read.elements.count("script") == 0);
        CHECK(svg.find("nan") == std::string::npos);
        CHECK(svg.find("inf") == std::string::npos);
        const auto titles = read.elements.find("title");
        CHECK((titles == read.elements.end() ? 0u : static_cast<std::size_t>(titles->second)) == points);
        if (points > 0) CHECK(read.says("a <b> & \"c\""));
        if (panels.empty()) CHECK(!read.says("every setting failed"));
    }
    CHECK(readXml(chartSvg({ChartPanel{}})).says("every setting failed"));
    // The checker itself sees what is wrong.
    for (const char* bad : {"<a>", "<a></b>", "<a>&</a>", "<a x=1></a>", "<a x=\"<\"></a>", "</a>", "<a x=\"1\" x=\"2\"></a>", "<a>\x01</a>", "text", "<a>></a>"}) CHECK(readXml(bad).fault != "");
    CHECK(readXml("<a x=\"1\"><b/>&lt;</a>").fault == "");
}

TEST_CASE("report: the table has a row a run and every column, and reads back") {
    Draw draw(streamOf("csv"));
    std::vector<Sweep> sweeps{sweepOf(draw, 30, false), sweepOf(draw, 0, true)};
    sweeps[1].motion = true;
    const auto rows = readCsv(runsCsv(sweeps));
    REQUIRE(rows.size() == 1 + sweeps[0].runs.size() + sweeps[1].runs.size());
    const std::vector<std::string>& head = rows[0];
    const auto column = [&](std::string_view name) { return static_cast<std::size_t>(std::ranges::find(head, name) - head.begin()); };
    for (const auto& row : errorRows()) CHECK(column(row.name) < head.size());
    for (const auto& row : costRows()) CHECK(column(row.name) < head.size());
    std::size_t at = 1;
    for (const Sweep& sweep : sweeps)
        for (std::size_t i = 0; i < sweep.runs.size(); ++i, ++at) {
            const Run& run = sweep.runs[i];
            const std::vector<std::string>& row = rows[at];
            REQUIRE(row.size() == head.size());
            CHECK(row[column("kind")] == (sweep.motion ? "motion" : "picture"));
            CHECK(row[column("knob")] == (!run.knob.empty() ? run.knob : i == 0 ? "own" : i == 1 ? "default" : "together"));
            CHECK(row[column("set")] == differences(run.setting, sweep.runs[0].setting));
            CHECK(row[column("reason")] == run.failure);
            CHECK((row[column("status")] == "FAILED") == run.failed());
            const auto same = [&](std::string_view name, double value) {
                const std::string& field = row[column(name)];
                if (std::isnan(value)) CHECK(field == "");
                else CHECK(std::strtod(field.c_str(), nullptr) == value);
            };
            same("value", run.value);
            for (const auto& r : errorRows()) same(r.name, run.errors[r.row]);
            for (const auto& r : costRows()) same(r.name, run.costs[r.row]);
        }
    CHECK(readCsv(runsCsv({})).size() == 1);
}

TEST_CASE("report: a panel has the runs that did not fail, and no others") {
    Draw draw(streamOf("panels"));
    int failed = 0;
    for (int round = 0; round < 20; ++round) {
        const Sweep sweep = sweepOf(draw, 40, round == 0);
        const Knob& knob = knobNamed("march_epsilon");
        // Each run has a cost of its own, by which a point tells whose it is.
        Sweep marked = sweep;
        for (std::size_t i = 0; i < marked.runs.size(); ++i)
            for (const Cost c : {Cost::evaluations, Cost::ms}) marked.runs[i].costs[c] *= 1 + 1e-6 * static_cast<double>(i);
        const auto check = [&](const std::vector<ChartPanel>& panels, bool knob_only, Cost cost_of_last) {
            for (std::size_t p = 0; p < panels.size(); ++p) {
                const Cost cost = p + 1 == panels.size() ? cost_of_last : marked.terms.cost;
                for (const ChartSeries& s : panels[p].series)
                    for (const ChartPoint& point : s.points) {
                        const auto of = std::ranges::find_if(marked.runs, [&](const Run& r) { return r.costs[cost] == point.y; });
                        REQUIRE(of != marked.runs.end());
                        CHECK(!of->failed());
                        if (knob_only) CHECK(of->knob == knob.key);
                    }
            }
        };
        for (const Run& run : marked.runs) failed += run.failed();
        const auto mine = knobPanels(marked, knob), all = overviewPanels(marked);
        CHECK(mine.size() == knob.moves.size() + 1);
        CHECK(all.size() == marked.terms.errors.size());
        check(mine, true, Cost::ms), check(all, false, Cost::evaluations);
        std::size_t drawn = 0, wanted = 0;
        for (const ChartPoint& p : all[0].series[0].points) drawn += !p.tip.empty();
        for (const Run& run : marked.runs) wanted += !run.failed() && run.errors.has(Error::color);
        CHECK(drawn == wanted);
        for (const auto* panels : {&mine, &all}) {
            const Markup svg = readXml(chartSvg(*panels));
            CHECK_MESSAGE(svg.fault.empty(), svg.fault);
        }
        CHECK(knobSays(marked, knob) != "");
        CHECK(frontSays(marked) != "");
        if (round == 0) CHECK(readXml(chartSvg(all)).says("every setting failed"));
    }
    CHECK(failed > 20);
}

TEST_CASE("report: the page is HTML whatever the texts, names its files and lists what failed with the reason") {
    Draw draw(streamOf("page"));
    for (const bool all_fail : {false, true}) {
        const Sweep pictures = sweepOf(draw, 10, all_fail);
        Sweep motions = sweepOf(draw, 10, all_fail);
        motions.motion = true, motions.terms = motionTerms();
        Page page{kHostile, kHostile, kHostile, {{&pictures, kHostile + "o"}, {&motions, "m.svg"}}, {}};
        page.knobs.push_back({&knobNamed("march_epsilon"), &pictures, kHostile + "k", {{{kHostile + "p", kHostile + "e", kHostile}}}});
        page.knobs.push_back({&knobNamed("dt"), &motions, "dt.svg", {}});
        const std::string html = reportHtml(page);
        const Markup read = readHtml(html);
        CHECK_MESSAGE(read.fault.empty(), read.fault);
        CHECK(read.elements.count("script") == 0);
        CHECK(read.elements.at("title") == 1);
        std::string kept;  // the hostile text but for what XML cannot hold
        for (const char c : kHostile)
            if (static_cast<unsigned char>(c) >= 0x20 || c == '\n') kept += c;
        const std::vector<std::string> sources = read.valuesOf("src");
        for (const std::string& file : std::vector<std::string>{kept + "o", "m.svg", kept + "k", kept + "p", kept + "e", "dt.svg"}) CHECK(std::ranges::count(sources, file) == 1);
        CHECK(sources.size() == 6);
        // One row for each run that failed, with its reason.
        std::size_t failed = 0;
        for (const Sweep* sweep : {&pictures, static_cast<const Sweep*>(&motions)}) failed += static_cast<std::size_t>(std::ranges::count_if(sweep->runs, &Run::failed));
        CHECK(failed > 0);
        CHECK(static_cast<std::size_t>(std::ranges::count(read.texts, "failed, because \"" + kept + "\"")) == failed);
        for (const KnobSection& section : page.knobs) CHECK(read.says(std::string(section.knob->meaning)));
        for (const auto& row : errorRows()) CHECK(read.says(std::string(row.meaning)));
    }
    // Nothing to say of: no sweep at all, and one whose own run is all there is.
    CHECK(readHtml(reportHtml({})).fault == "");
    Sweep lone;
    lone.terms = pictureTerms(), lone.runs = {runOf({})};
    lone.runs[0].errors[Error::color] = 0, lone.runs[0].costs[Cost::evaluations] = 1;
    Page page{"s", "r", "1 by 1", {{&lone, "o.svg"}}, {{&knobNamed("samples"), &lone, "k.svg", {}}}};
    const Markup read = readHtml(reportHtml(page));
    CHECK_MESSAGE(read.fault.empty(), read.fault);
    CHECK(read.says("No setting failed."));
    CHECK(readXml(chartSvg(overviewPanels(lone))).fault == "");
    // And one that has not begun.
    lone.runs.clear();
    const Markup begun = readHtml(reportHtml(page));
    CHECK_MESSAGE(begun.fault.empty(), begun.fault);
    CHECK(readXml(chartSvg(overviewPanels(lone))).says("every setting failed"));
    CHECK(readCsv(runsCsv({&lone, 1})).size() == 1);
}
