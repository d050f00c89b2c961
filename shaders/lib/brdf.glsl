#ifndef TYNDALL_LIB_BRDF
#define TYNDALL_LIB_BRDF

// The metallic-roughness BRDF of glTF 2.0, appendix B. n is the surface normal, v points to the eye, l to the light,
// h is half way between l and v; all unit and all pointing away from the surface. Values in 1/sr.

const float BRDF_PI = 3.14159265358979f;

// Smaller perceptual roughnesses are taken as this: a mirror would show a point light as nothing or as infinity.
const float BRDF_MIN_ROUGHNESS = 0.045f;

// A dielectric's reflectance at normal incidence (f0; 0.04 for the index of refraction 1.5) is stored in 8 bits as a
// part of this: 0.04 is 51/255 of it, and greater ones, of indices above 2.6, are drawn as this.
const float BRDF_F0_STORED = 0.2f;

float brdf_alpha(float roughness) {
    float r = clamp(roughness, BRDF_MIN_ROUGHNESS, 1.0f);
    return r * r;
}

// Reflectance at grazing incidence: 1, but for dielectrics that reflect less than 2% head-on, which no matter does. There
// the whole lobe fades out with f0 (Lagarde and de Rousiers 2014, 4.7.2), so that f0 = 0 is a Lambert surface.
float brdf_f90(float dielectric_f0, float metallic) {
    return mix(clamp(50.0f * dielectric_f0, 0.0f, 1.0f), 1.0f, metallic);
}

// Schlick 1994: f0 at v = h, f90 at grazing incidence.
vec3 fresnel_schlick(vec3 f0, float f90, float v_dot_h) {
    float m = clamp(1.0f - v_dot_h, 0.0f, 1.0f);
    float m2 = m * m;
    return f0 + (vec3(f90) - f0) * (m2 * m2 * m);
}

// Trowbridge and Reitz 1975 (GGX): the distribution of microfacet normals, int D (n.h) dh = 1.
// n_dot_h^2 (alpha^2 - 1) + 1 is written as alpha^2 c^2 + (1 - c^2), whose second term does not lose the peak's width.
float distribution_ggx(float n_dot_h, float alpha) {
    float c2 = n_dot_h * n_dot_h;
    float d = alpha * alpha * c2 + max(1.0f - c2, 0.0f);
    return alpha * alpha / (BRDF_PI * d * d);
}

// Height-correlated Smith masking and shadowing over 4 (n.l) (n.v) (Heitz 2014, eq. 99); 1/4 for a mirror seen head-on.
float visibility_smith(float n_dot_l, float n_dot_v, float alpha) {
    float a2 = alpha * alpha;
    float masking = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0f - a2) + a2);
    float shadowing = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0f - a2) + a2);
    return 0.5f / max(masking + shadowing, 1.0e-7f);
}

// f(l, v) [1/sr], without the cosine: reflected radiance = f * (n.l) * illuminance. 0 below the horizon of l; of v the
// side does not count, since interpolated and bent normals may turn away from the eye. As in the appendix, the diffuse
// part does not know how much the specular one took in all: a white dielectric seen at cos 0.05 reflects 1.03 times
// what it receives at roughness 0.8, 1.7 times at 0.05; metals, and anything seen from above 45 degrees, never more
// than 1.
struct BrdfLobes {
    vec3 diffuse;
    vec3 specular;
};

BrdfLobes brdf_lobes(vec3 base_color, float metallic, float roughness, float dielectric_f0, vec3 n, vec3 v, vec3 l) {
    float n_dot_l = dot(n, l);
    BrdfLobes lobes;
    lobes.diffuse = vec3(0.0f);
    lobes.specular = vec3(0.0f);
    if (n_dot_l <= 0.0f) {
        return lobes;
    }
    vec3 h = normalize(l + v);
    float alpha = brdf_alpha(roughness);
    float n_dot_v = max(abs(dot(n, v)), 1.0e-4f);
    vec3 f0 = mix(vec3(dielectric_f0), base_color, metallic);
    vec3 fresnel = fresnel_schlick(f0, brdf_f90(dielectric_f0, metallic), dot(v, h));
    lobes.diffuse = (1.0f - fresnel) * base_color * ((1.0f - metallic) / BRDF_PI);
    lobes.specular = fresnel * (distribution_ggx(clamp(dot(n, h), 0.0f, 1.0f), alpha) *
                                visibility_smith(n_dot_l, n_dot_v, alpha));
    return lobes;
}

vec3 brdf_metallic_roughness(vec3 base_color, float metallic, float roughness, float dielectric_f0, vec3 n, vec3 v,
                             vec3 l) {
    BrdfLobes lobes = brdf_lobes(base_color, metallic, roughness, dielectric_f0, n, v, l);
    return lobes.diffuse + lobes.specular;
}

// Directional albedo of the specular lobe, int f_specular (n.l) dl = f0 * x + f90 * y: the split sum of Karis 2013 ("Real
// Shading in Unreal Engine 4"), fitted to this file's lobe for n.v >= 1/8; maximal errors of x + y 0.045, of y 0.025.
vec2 specular_albedo_scale(float roughness, float n_dot_v) {
    float r = roughness;
    float c = n_dot_v;
    float a = r * r;
    float lost = a * (1.5031f + r * (-2.2697f + 7.4203f * c + 0.2368f * c * c) - c * (2.1816f + 0.7657f * c) +
                      a * (0.1482f - 4.2032f * c + 0.7918f * r));
    float whole = clamp(1.0f - lost, 0.0f, 1.0f);
    float grazing = (1.4187f - 3.3274f * r + 2.0657f * a) * exp2(-(11.0016f - 20.7418f * r + 34.0617f * a) * c) +
                    r * (1.0f - c) * (0.0431f - 0.0246f * r);
    grazing = clamp(grazing, 0.0f, whole);
    return vec2(whole - grazing, grazing);
}

#endif
