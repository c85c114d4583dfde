#pragma once
// Charts on two logarithmic axes, as SVG: what an error costs.
#include <string>
#include <vector>

namespace mb {

struct ChartPoint {
    double x = 0, y = 0;
    std::string label;            // beside it; and, where `tip` is empty, shown under the mouse
    std::string tip;
    int run = -1;                 // the sweep's run it is of; -1: none
};
struct ChartSeries {
    enum class Look { line, faint_dots, own, usual, better } look = Look::line;
    std::string name;             // in the legend; empty: it is not there
    std::vector<ChartPoint> points;
};
/// A pair of axes. An error of 0 has no logarithm: it stands in a column of its own at the left, under "none".
struct ChartPanel {
    std::string title, x_label, y_label;
    std::vector<ChartSeries> series;
};

/// A logarithmic axis that holds all of some values but those that are 0: its lines are powers of ten, or 1, 2 and 5 times these where
/// the values are close together. The first is its beginning and the last its end.
struct Axis {
    std::vector<double> lines{1, 10};
    bool zero = false;            // some value is 0
};
Axis axisOf(const std::vector<double>& values);
/// Where a value lies on an axis, 0 to 1. `gap` is the width of the column of 0, as a share of the axis, where there is one.
double placeOn(const Axis& axis, double value, double gap);
inline constexpr double kZeroColumn = 0.09;

/// The panels beside one another, three in a row, with a legend below. Any text is allowed in what it is given.
std::string chartSvg(const std::vector<ChartPanel>& panels);

/// Text as it may stand in XML.
std::string escaped(std::string_view text);
/// A number short enough to read: three digits.
std::string brief(double x);
/// A line's number as an axis names it.
std::string lineName(double value);

}  // namespace mb
