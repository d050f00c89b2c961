#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "bench/techniques.h"

namespace tyndall::bench {

/// A picture being written as SVG, on white whatever the page's theme. Pixels, y down.
class Svg {
  public:
    explicit Svg(glm::dvec2 size);

    struct TextStyle {
        double size = 12;
        std::string color = "#333333";
        const char* anchor = "start";  ///< start, middle or end
        bool bold = false;
        bool halo = false;  ///< white around the letters
        double turn = 0;    ///< degrees
    };
    void text(glm::dvec2 at, const std::string& content, const TextStyle& style);
    void line(glm::dvec2 a, glm::dvec2 b, const std::string& color, double width = 1, const std::string& dash = "");
    void polyline(const std::vector<glm::dvec2>& points, const std::string& color, double width, double opacity = 1,
                  const std::string& dash = "");
    void polygon(const std::vector<glm::dvec2>& points, const std::string& color, double opacity);
    void rectangle(glm::dvec2 at, glm::dvec2 size, const std::string& color, const std::string& tooltip = "");
    /// `tooltip` shows under the pointer where the file is opened in a browser.
    void marker(Marker marker, glm::dvec2 at, double radius, const std::string& color,
                const std::string& tooltip = "");
    [[nodiscard]] std::string finish() const { return text_ + "</svg>\n"; }

  private:
    std::string text_;
};

[[nodiscard]] std::string xml_escaped(const std::string& text);

}  // namespace tyndall::bench
