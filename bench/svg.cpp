#include "bench/svg.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace tyndall::bench {
namespace {

constexpr const char* fonts = "system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";

std::string list(const std::vector<glm::dvec2>& points) {
    std::string text;
    for (const glm::dvec2 p : points) text += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
    if (!text.empty()) text.pop_back();
    return text;
}

std::string dashes(const std::string& dash) {
    return dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dash);
}

/// Corners of a regular figure around the origin; `inner` < 1 pulls every second one in, as of a star.
std::vector<glm::dvec2> corners(int count, double radius, double turn, double inner = 1) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count + turn;
        const double r = i % 2 == 1 ? radius * inner : radius;
        points.emplace_back(r * std::sin(angle), -r * std::cos(angle));
    }
    return points;
}

std::vector<glm::dvec2> outline(Marker marker, double r) {
    constexpr double pi = std::numbers::pi;
    switch (marker) {
        case Marker::square:
            return corners(4, 1.2 * r, pi / 4);
        case Marker::triangle:
            return corners(3, 1.3 * r, 0);
        case Marker::triangle_down:
            return corners(3, 1.3 * r, pi);
        case Marker::diamond:
            return corners(4, 1.3 * r, 0);
        case Marker::star:
            return corners(10, 1.5 * r, 0, 0.45);
        case Marker::plus:
        case Marker::cross: {
            const double a = 1.3 * r, b = 0.4 * r;
            std::vector<glm::dvec2> points{{-b, -a}, {b, -a}, {b, -b}, {a, -b}, {a, b},   {b, b},
                                           {b, a},   {-b, a}, {-b, b}, {-a, b}, {-a, -b}, {-b, -b}};
            const double s = std::sqrt(0.5);
            if (marker == Marker::cross)
                for (glm::dvec2& p : points) p = {s * (p.x - p.y), s * (p.x + p.y)};
            return points;
        }
        case Marker::circle:
            break;
    }
    return corners(24, r, 0);
}

}  // namespace

std::string xml_escaped(const std::string& text) {
    std::string escaped;
    for (const char c : text) switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    return escaped;
}

Svg::Svg(glm::dvec2 size)
    : text_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
                        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"{2}\">\n"
                        "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n",
                        size.x, size.y, fonts)) {}

void Svg::text(glm::dvec2 at, const std::string& content, const TextStyle& style) {
    const std::string turn =
        style.turn != 0 ? fmt::format(" transform=\"rotate({:.0f} {:.1f} {:.1f})\"", style.turn, at.x, at.y) : "";
    text_ += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:g}\" fill=\"{}\" text-anchor=\"{}\"{}{}{}>{}</text>\n", at.x,
        at.y, style.size, style.color, style.anchor, style.bold ? " font-weight=\"bold\"" : "",
        style.halo ? " stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\"" : "",
        turn, xml_escaped(content));
}

void Svg::line(glm::dvec2 a, glm::dvec2 b, const std::string& color, double width, const std::string& dash) {
    text_ += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"{:g}\"{}/>\n",
        a.x, a.y, b.x, b.y, color, width, dashes(dash));
}

void Svg::polyline(const std::vector<glm::dvec2>& points, const std::string& color, double width, double opacity,
                   const std::string& dash) {
    text_ += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\" stroke-opacity=\"{:g}\" "
        "stroke-linejoin=\"round\"{}/>\n",
        list(points), color, width, opacity, dashes(dash));
}

void Svg::polygon(const std::vector<glm::dvec2>& points, const std::string& color, double opacity) {
    text_ +=
        fmt::format("<polygon points=\"{}\" fill=\"{}\" fill-opacity=\"{:g}\"/>\n", list(points), color, opacity);
}

void Svg::rectangle(glm::dvec2 at, glm::dvec2 size, const std::string& color, const std::string& tooltip) {
    text_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\">", at.x,
                         at.y, size.x, size.y, color);
    if (!tooltip.empty()) text_ += "<title>" + xml_escaped(tooltip) + "</title>";
    text_ += "</rect>\n";
}

void Svg::marker(Marker marker, glm::dvec2 at, double radius, const std::string& color,
                 const std::string& tooltip) {
    std::vector<glm::dvec2> points = outline(marker, radius);
    for (glm::dvec2& p : points) p += at;
    text_ += fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"#ffffff\" stroke-width=\"0.7\">",
                         list(points), color);
    if (!tooltip.empty()) text_ += "<title>" + xml_escaped(tooltip) + "</title>";
    text_ += "</polygon>\n";
}

}  // namespace tyndall::bench
