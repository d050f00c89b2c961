// bayer_rank is there now.
#include "shaders/lib/sampling_noise.glsl"
