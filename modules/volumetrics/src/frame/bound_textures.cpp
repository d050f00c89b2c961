#include "frame/passes.h"

namespace tyndall::volumetrics {

BoundTextures::BoundTextures(std::initializer_list<Unit> units) : count_(units.size()) {
    GLuint index = 0;
    for (const Unit& unit : units) {
        glBindTextureUnit(index, unit.texture.id);
        glBindSampler(index++, unit.sampler.id());
    }
}

BoundTextures::~BoundTextures() {
    for (GLuint index = 0; index < count_; ++index) glBindSampler(index, 0);
}

}  // namespace tyndall::volumetrics
