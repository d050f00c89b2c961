#pragma once

#include <vector>

#include "frame/resources.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {

/// On units 0, 1, 2 …; unbinds the samplers when it goes, so that none outlives the pass on a host's texture.
class BoundSources {
  public:
    BoundSources(const PassContext& context, const std::vector<Pass::Source>& sources, const Resources& resources)
        : count_(static_cast<GLuint>(sources.size())) {
        for (GLuint unit = 0; unit < count_; ++unit) {
            const auto& [texture, linear] = sources[unit];
            if (!texture) continue;
            glBindTextureUnit(unit, context.texture(texture).id);
            glBindSampler(unit, (linear ? resources.linear : resources.nearest).id());
        }
    }
    ~BoundSources() {
        for (GLuint unit = 0; unit < count_; ++unit) glBindSampler(unit, 0);
    }
    BoundSources(const BoundSources&) = delete;
    BoundSources& operator=(const BoundSources&) = delete;

  private:
    GLuint count_;
};

}  // namespace tyndall::volumetrics
