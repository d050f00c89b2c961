#pragma once

#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {

/// Asks, as a host's lighting pass would, what media leave of light on its way to points.
class LightProbe {
  public:
    LightProbe();
    /// Of the sun, or of a lamp by its index.
    [[nodiscard]] std::vector<glm::vec3> transmittance(StubHost& host, const Settings& settings,
                                                       const std::vector<glm::vec3>& points, int lamp = -1);
    /// What the last call's frame says of a pass: why it did not run; empty: it ran.
    [[nodiscard]] std::string skipped(const std::string& pass) const {
        const auto found = skipped_.find(pass);
        return found == skipped_.end() ? "not in the list" : found->second;
    }
    [[nodiscard]] const gl::Program& program(int light_volumes);
    [[nodiscard]] Roots roots() const { return folder_.roots(); }

  private:
    ShaderFolder folder_;
    ShaderLibrary programs_;
    TransientPool pool_;
    std::map<std::string, std::string> skipped_;
};

}  // namespace tyndall::test
