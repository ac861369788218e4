// Light on a point of a surface. Included after ggx.glsl, environment.glsl, shadow_filter.glsl and the declarations of
// `environment`, `lights`, `shadowMaps`, `specularEnvironment` and `reflectanceImage`.

struct Surface {
    vec3 position;
    vec3 normal;       ///< with the normal map
    vec3 vertexNormal; ///< without it
    vec3 toView;
    vec3 f0;
    float alpha;
    float secondLobe;  ///< its share of the reflection
    float secondAlpha; ///< of the second lobe
};

struct Light {
    vec3 diffuse; ///< irradiance
    vec3 specular; ///< radiance
};

/// Irradiance on a surface that faces the light, at `position`, and the way to the light (KHR_lights_punctual).
vec3 arrivingLight(LightConstants light, vec3 position, out vec3 toLight) {
    if (light.kind.x == lightDirectional) {
        toLight = -light.direction.xyz;
        return light.irradiance.rgb;
    }
    vec3 offset = light.position.xyz - position;
    float distance = length(offset);
    toLight = offset / max(distance, 1e-20);
    float meters = distance * light.irradiance.w;
    float ratio = light.position.w > 0.0 ? distance / light.position.w : 0.0;
    float falloff = clamp(1.0 - ratio * ratio * ratio * ratio, 0.0, 1.0) / max(meters * meters, 1e-8);
    float cone = 1.0;
    if (light.cone.x > 0.0) {
        cone = clamp(-dot(light.direction.xyz, toLight) * light.cone.x + light.cone.y, 0.0, 1.0);
    }
    return light.irradiance.rgb * (falloff * cone * cone);
}

void addPunctual(inout Light result, Surface surface, LightConstants light) {
    vec3 toLight;
    vec3 arriving = arrivingLight(light, surface.position, toLight);
    float nDotL = dot(surface.normal, toLight);
    if (nDotL <= 0.0 || max(arriving.r, max(arriving.g, arriving.b)) <= 0.0) {
        return;
    }
    vec3 irradiance =
        arriving * (nDotL * shadowVisibility(shadowMaps, light, surface.position, surface.vertexNormal, toLight));
    result.diffuse += irradiance;
    vec3 halfway = normalize(toLight + surface.toView);
    float nDotV = max(dot(surface.normal, surface.toView), 1e-4);
    float nDotH = clamp(dot(surface.normal, halfway), 0.0, 1.0);
    vec3 reflected = fresnel(surface.f0, clamp(dot(surface.toView, halfway), 0.0, 1.0));
    float lobe = ggxDistribution(nDotH, surface.alpha) * ggxVisibility(nDotL, nDotV, surface.alpha);
    if (surface.secondLobe > 0.0) {
        lobe = mix(lobe, ggxDistribution(nDotH, surface.secondAlpha) * ggxVisibility(nDotL, nDotV, surface.secondAlpha),
                   surface.secondLobe);
    }
    result.specular += irradiance * reflected * lobe;
}

/// How much of a reflection an ambient occlusion of `visibility` lets through (Lagarde and de Rousiers 2014, "Moving
/// Frostbite to PBR", listing 26).
float specularVisibility(float nDotV, float visibility, float alpha) {
    return clamp(pow(nDotV + visibility, exp2(-16.0 * alpha - 1.0)) - 1.0 + visibility, 0.0, 1.0);
}

/// What a lobe reflects of the environment: radiance.
vec3 environmentReflection(Surface surface, float visibility, float alpha) {
    float roughness = sqrt(alpha);
    float nDotV = clamp(dot(surface.normal, surface.toView), 1e-4, 1.0);
    vec2 reflectance = textureLod(reflectanceImage, vec2(nDotV, roughness), 0.0).rg;
    vec3 direction = environmentDirection(reflect(-surface.toView, surface.normal), environment.rotation.xy);
    vec3 radiance = textureLod(specularEnvironment, direction, roughness * float(specularLevels - 1u)).rgb;
    return radiance * (surface.f0 * reflectance.x + reflectance.y) *
           (environment.rotation.z * specularVisibility(nDotV, visibility, alpha));
}

void addEnvironment(inout Light result, Surface surface, float visibility) {
    result.diffuse += environmentIrradiance(environment, surface.normal) * visibility;
    vec3 reflected = environmentReflection(surface, visibility, surface.alpha);
    if (surface.secondLobe > 0.0) {
        reflected = mix(reflected, environmentReflection(surface, visibility, surface.secondAlpha), surface.secondLobe);
    }
    result.specular += reflected;
}

float alphaOf(float roughness) {
    return max(roughness * roughness, 2e-3);
}

/// Of the first `lightCount` lights and of the surroundings, whose share `visibility` is not occluded.
Light lightOn(Surface surface, uint lightCount, float visibility) {
    Light result = Light(vec3(0.0), vec3(0.0));
    for (uint i = 0u; i < lightCount; ++i) {
        addPunctual(result, surface, lights[i]);
    }
    addEnvironment(result, surface, visibility);
    return result;
}
