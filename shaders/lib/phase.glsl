#ifndef TYNDALL_LIB_PHASE
#define TYNDALL_LIB_PHASE

// Phase functions p(cos_theta) [1/sr]. cos_theta is between the direction in which light travels and the
// direction in which it leaves towards the eye: +1 is forward scattering, and g > 0 scatters forward.
// Each integrates to 1 over the sphere.

const float PI = 3.14159265358979f;

const int PHASE_ISOTROPIC = 0;
const int PHASE_HENYEY_GREENSTEIN = 1;
const int PHASE_SCHLICK = 2;
const int PHASE_CORNETTE_SHANKS = 3;
const int PHASE_DOUBLE_HENYEY_GREENSTEIN = 4;
const int PHASE_HG_DRAINE = 5;

// |g| above this is taken as this: at 1 the lobes become a delta.
const float PHASE_MAX_ANISOTROPY = 0.999f;

float phase_isotropic() {
    return 0.25f / PI;
}

// Henyey and Greenstein 1941: (1 - g^2) / (4 pi (1 + g^2 - 2 g cos_theta)^(3/2)); its mean cosine is g.
// With a = |g| the bracket is (1 - a)^2 + 2 a (1 - sign(g) cos_theta), which does not cancel at the peak.
// g = 0 is isotropic.
float phase_henyey_greenstein(float g, float cos_theta) {
    float a = min(abs(g), PHASE_MAX_ANISOTROPY);
    float signed_cos_theta = g < 0.0f ? -cos_theta : cos_theta;
    float bracket = (1.0f - a) * (1.0f - a) + 2.0f * a * max(1.0f - signed_cos_theta, 0.0f);
    return 0.25f / PI * (1.0f - a) * (1.0f + a) / (bracket * sqrt(bracket));
}

// Blasi, Le Saec, Schlick 1993: (1 - k^2) / (4 pi (1 - k cos_theta)^2) with k = 1.55 g - 0.55 g^3, a
// Henyey-Greenstein without the power. The fit of k passes 1 at |g| = 0.938, where the function would be
// singular and then negative, so |k| is held at PHASE_MAX_ANISOTROPY: from |g| = 0.929 on the lobe stays as it is.
float phase_schlick(float g, float cos_theta) {
    float k = min(abs(1.55f * g - 0.55f * g * g * g), PHASE_MAX_ANISOTROPY);
    float signed_cos_theta = g < 0.0f ? -cos_theta : cos_theta;
    float bracket = (1.0f - k) + k * max(1.0f - signed_cos_theta, 0.0f);
    return 0.25f / PI * (1.0f - k) * (1.0f + k) / (bracket * bracket);
}

// Molecules of air, and all that is far smaller than the wavelength: 3 (1 + cos_theta^2) / (16 pi) for unpolarised
// light (Rayleigh 1871). Symmetric, so its mean cosine is 0.
float phase_rayleigh(float cos_theta) {
    return 0.1875f / PI * (1.0f + cos_theta * cos_theta);
}

// Cornette and Shanks 1992 (Applied Optics 31, 3152): Henyey-Greenstein with the Rayleigh factor,
//     3 (1 - g^2) (1 + cos_theta^2) / (8 pi (2 + g^2) (1 + g^2 - 2 g cos_theta)^(3/2)).
// g = 0 is Rayleigh, |g| -> 1 is Henyey-Greenstein. The mean cosine is not g but 3 g (4 + g^2) / (5 (2 + g^2)).
float phase_cornette_shanks(float g, float cos_theta) {
    float a = min(abs(g), PHASE_MAX_ANISOTROPY);
    return 1.5f * (1.0f + cos_theta * cos_theta) / (2.0f + a * a) * phase_henyey_greenstein(g, cos_theta);
}

// Draine 2003 (Astrophysical Journal 598, 1017): Henyey-Greenstein times (1 + alpha cos_theta^2), normalised by that factor's mean
// 1 + alpha (1 + 2 g^2) / 3. alpha = 0 is Henyey-Greenstein, g = 0 and alpha = 1 Rayleigh. Its mean cosine is
// g (1 + alpha (3 + 2 g^2) / 5) / (1 + alpha (1 + 2 g^2) / 3).
float phase_draine(float g, float alpha, float cos_theta) {
    return (1.0f + alpha * cos_theta * cos_theta) / (1.0f + alpha * (1.0f + 2.0f * g * g) / 3.0f) *
           phase_henyey_greenstein(g, cos_theta);
}

// A lobe of Henyey-Greenstein, and the share second_weight, 0..1, of the light in one of Draine. With second_alpha = 0 and
// second_g < 0 the double Henyey-Greenstein (Irvine 1965, Astrophysical Journal 142, 1563) with the backward peak of hazes
// and clouds. The mean cosine is that of the lobes, by their shares; weights 0 and 1 are the lobes alone.
float phase_two_lobes(float g, float second_g, float second_alpha, float second_weight, float cos_theta) {
    return (1.0f - second_weight) * phase_henyey_greenstein(g, cos_theta) +
           second_weight * phase_draine(second_g, second_alpha, cos_theta);
}

// Those two lobes fitted to water droplets in visible light, whose diameter is 5..50 um (Jendersie and d'Eon 2023, "An Approximate
// Mie Scattering Function for Fog and Cloud Rendering", equations 4 to 7): g, second_g, second_alpha, second_weight.
vec4 phase_of_droplets(float diameter) {
    return vec4(exp(-0.0990567f / (diameter - 1.67154f)), exp(-2.20679f / (diameter + 3.91029f) - 0.428934f),
                exp(3.62489f - 8.29288f / (diameter + 5.52825f)), exp(-0.599085f / (diameter - 0.641583f) - 0.665888f));
}

// Of those with one lobe.
float phase(int kind, float g, float cos_theta) {
    if (kind == PHASE_HENYEY_GREENSTEIN) {
        return phase_henyey_greenstein(g, cos_theta);
    }
    if (kind == PHASE_SCHLICK) {
        return phase_schlick(g, cos_theta);
    }
    if (kind == PHASE_CORNETTE_SHANKS) {
        return phase_cornette_shanks(g, cos_theta);
    }
    return phase_isotropic();
}

// Of all.
float phase(int kind, float g, float second_g, float second_alpha, float second_weight, float cos_theta) {
    if (kind == PHASE_DOUBLE_HENYEY_GREENSTEIN || kind == PHASE_HG_DRAINE) {
        return phase_two_lobes(g, second_g, second_alpha, second_weight, cos_theta);
    }
    return phase(kind, g, cos_theta);
}

// Mean cosine of the scattering angle, of the functions above.
float phase_mean_cosine_schlick(float g) {
    float k = min(abs(1.55f * g - 0.55f * g * g * g), PHASE_MAX_ANISOTROPY);
    float k2 = k * k;
    // 1 / k - (1 - k^2) / (2 k^2) log((1 + k) / (1 - k)), which cancels where k is small.
    float mean = k * (2.0f / 3.0f + k2 * (2.0f / 15.0f + k2 * (2.0f / 35.0f)));
    if (k > 0.2f) {
        mean = 1.0f / k - (1.0f - k2) / (2.0f * k2) * log((1.0f + k) / (1.0f - k));
    }
    return g < 0.0f ? -mean : mean;
}

float phase_mean_cosine_draine(float g, float alpha) {
    return g * (1.0f + alpha * (3.0f + 2.0f * g * g) / 5.0f) / (1.0f + alpha * (1.0f + 2.0f * g * g) / 3.0f);
}

float phase_mean_cosine(int kind, float g) {
    if (kind == PHASE_ISOTROPIC) {
        return 0.0f;
    }
    if (kind == PHASE_SCHLICK) {
        return phase_mean_cosine_schlick(g);
    }
    if (kind == PHASE_CORNETTE_SHANKS) {
        return 3.0f * g * (4.0f + g * g) / (5.0f * (2.0f + g * g));
    }
    return g;
}

#endif
