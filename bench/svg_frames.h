#pragma once

#include <string>
#include <vector>

namespace tyndall::bench {

/// Values over frames 0, 1, 2 …: one line of a panel, one entry of the legend by its name.
struct FrameCurve {
    std::string name, color;
    std::vector<double> values;  ///< those that are not positive and finite do not show
    bool dashed = false;
};

/// Panels side by side, with one axis of values (logarithmic) and one of frames (linear) for all of them.
struct FramesPlot {
    std::string title, subtitle, y_label;
    struct Panel {
        std::string title;
        std::vector<FrameCurve> curves;
    };
    std::vector<Panel> panels;
    struct Span {
        int first, last;  ///< frames
        std::string name;
    };
    std::vector<Span> spans;  ///< shaded and named in each panel
    int columns = 3;          ///< panels in a row, at most
};
[[nodiscard]] std::string svg_frames(const FramesPlot& plot);

/// The n-th colour of a legend: Okabe and Ito's, that all kinds of colour vision tell apart, and their neighbours.
[[nodiscard]] std::string legend_color(std::size_t n);

}  // namespace tyndall::bench
