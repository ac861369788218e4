// Structures that C++ and GLSL share. Only vec4, uvec4 and mat4 members, so that std140, std430 and C++ agree.
#ifndef NACRE_RENDERER_SHADER_TYPES_H
#define NACRE_RENDERER_SHADER_TYPES_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace nacre::renderer::shared {
using glm::mat4;
using glm::uvec4;
using glm::vec4;
#define NACRE_CONSTANT inline constexpr unsigned
#else
#define NACRE_CONSTANT const uint
#endif

/// Side of a compute workgroup in pixels.
NACRE_CONSTANT groupSize = 16;

NACRE_CONSTANT noShadow = 0xffffffffu;

/// The textures of a surface, in the order of scene::textureSlots.
NACRE_CONSTANT baseColorSlot = 0;
NACRE_CONSTANT normalSlot = 1;
NACRE_CONSTANT metallicRoughnessSlot = 2;
NACRE_CONSTANT thicknessSlot = 3;
NACRE_CONSTANT emissionSlot = 4;
NACRE_CONSTANT scaleSlot = 5;
NACRE_CONSTANT transmissionSlot = 6;
NACRE_CONSTANT transmissionColorSlot = 7;
NACRE_CONSTANT textureSlotCount = 8;

/// DrawConstants::index.w: 1 << slot where there is a texture, and this.
NACRE_CONSTANT isDoubleSided = 0x80000000u;

/// LightConstants::kind.x, as NacreLightKind
NACRE_CONSTANT lightDirectional = 0;
NACRE_CONSTANT lightSpot = 1;
NACRE_CONSTANT lightPoint = 2;

/// Mip levels of the prefiltered environment; level i holds roughness i / (specularLevels - 1).
NACRE_CONSTANT specularLevels = 6;

/// The camera of one frame.
struct ViewConstants {
    mat4 clipFromWorld;
    mat4 worldFromView;
    vec4 viewRow;   ///< dot with vec4(world position, 1) is the linear depth
    vec4 unproject; ///< view xy = (ndc + zw) * xy, times the linear depth when the projection is a perspective
    uvec4 size;     ///< width, height, 1 for a perspective, 0
};

/// A surface's constants; textures are bound beside them.
struct SurfaceConstants {
    vec4 baseColor;
    vec4 emission;     ///< w: normalScale
    vec4 parameters;   ///< metallic, roughness, specular, alpha cutoff
    vec4 lengths;      ///< x: authored thickness, mm, 0 = none; y: scale of the material's; z: 1 where the
                       ///< transmission texture multiplies the material's strength, too
    vec4 uvTransformU[textureSlotCount]; ///< dot with vec3(uv, 1) is the transformed u; w: 1 = of the second uv
    vec4 uvTransformV[textureSlotCount]; ///< the same for v
    uvec4 material;    ///< x: material id
};

/// What one draw pushes.
struct DrawConstants {
    mat4 worldFromObject;
    uvec4 index; ///< x: surface, y: the pass's own (shadow layer, blended layer, lights), z: 1 when the transform mirrors, w: flags above
};

/// What the shaders read of a NacreLight.
struct LightConstants {
    vec4 position;   ///< w: range in scene units, 0 = unlimited
    vec4 direction;  ///< the way the light travels, normalised; w: shadow range in scene units
    vec4 irradiance; ///< facing it; spot, point: at one metre. w: metres per unit
    vec4 cone;       ///< x, y: scale and offset of the cone's cosine; 0: no cone
    uvec4 kind;      ///< x: kind, y: first shadow layer or noShadow
    mat4 shadowClipFromWorld;
};

/// One layer of the shadow maps, as it is drawn.
struct ShadowLayer {
    mat4 clipFromWorld;
    vec4 origin;    ///< linear depth is measured from here; w: 1 / shadow range, negative where the layer is a mirror image
    vec4 direction; ///< w: 1 when depth is along the direction, 0 when it is the distance from the origin
};

/// Steps of TransmissionConstants::through.
NACRE_CONSTANT throughSteps = 16;

/// How a material's diffuse light divides between the two sides of a surface.
struct TransmissionConstants {
    vec4 color; ///< of what comes through; w: 1, or 0 for the albedo
    vec4 share; ///< x: f of a thin wall, 0 = a closed body; y: mm, thickness in the middle of `through`
    vec4 through[throughSteps + 1]; ///< transmittance of a slab of y / (y + thickness) · throughSteps, times translucency
};

/// A material's second specular lobe.
struct LobeConstants {
    vec4 second; ///< x: its share of the reflection, 0 = there is none; y: its roughness over the first's
};

/// The environment's diffuse irradiance: nine spherical harmonics, cosine lobe folded in.
struct EnvironmentConstants {
    vec4 irradiance[9];
    vec4 rotation; ///< x, y: cosine and sine of the rotation about +Y; z: intensity
};

/// AccumulateConstants::image.x, as ShownImage. Up to shownSpecular they are light.
NACRE_CONSTANT shownPicture = 0;
NACRE_CONSTANT shownDiffuse = 1;
NACRE_CONSTANT shownIrradiance = 2;
NACRE_CONSTANT shownScattered = 3;
NACRE_CONSTANT shownTransmitted = 4;
NACRE_CONSTANT shownSpecular = 5;
NACRE_CONSTANT shownAlbedo = 6;
NACRE_CONSTANT shownNormal = 7;
NACRE_CONSTANT shownDepth = 8;
NACRE_CONSTANT shownThickness = 9;
NACRE_CONSTANT shownMaterial = 10;
NACRE_CONSTANT shownFootprint = 11;
NACRE_CONSTANT shownShadowMap = 12;
NACRE_CONSTANT shownRegions = 13;
NACRE_CONSTANT shownGiven = 14;

/// AccumulateConstants::size.w, as Backdrop.
NACRE_CONSTANT backdropSurroundings = 0;

/// AccumulateConstants::effect.w, as ToneCurve.
NACRE_CONSTANT curveNeutral = 0;

/// ShowConstants::place.z, as ShownSides.
NACRE_CONSTANT showFirst = 0;
NACRE_CONSTANT showBoth = 1;
NACRE_CONSTANT showDifference = 2;

/// A sample that is added to a side.
struct AccumulateConstants {
    uvec4 image;  ///< x: which, y: samples that are there, z: layer of the shadow maps, w: 1 where a given picture is
                  ///< what a display shows
    uvec4 size;   ///< x, y: pixels, z: the side's first pixel among all, w: backdrop
    uvec4 effect; ///< x: scatter, y: scattered has albedo, z: transmit, w: tone curve
    vec4 range;   ///< x, y: values at the ends of depth and thickness, z: exposure, w: px per mm at a depth of 1;
                  ///< negative: at all depths. Of regions: y: SampleLook::separation, w: the width of a pixel at a depth
                  ///< of 1, likewise
};

/// A mark on top of the picture: a disc, and a line from it.
struct Mark {
    vec4 place; ///< [0, 1] of the picture, right and down: x, y: the disc, z, w: the line's end
    vec4 color; ///< rgb: as a display shows it, sRGB encoded; w: radius of the disc, px; negative: a ring
};

/// The window's pixels.
struct ShowConstants {
    uvec4 place;    ///< x, y: pixels, z: what, w: 1 for B G R A
    uvec4 sides[2]; ///< x, y: pixels, z: first pixel
    vec4 divider;   ///< x: where the second side begins, [0, 1]; y: what a difference is multiplied by; z: marks
};

#ifdef __cplusplus
static_assert(sizeof(AccumulateConstants) == 64);
static_assert(sizeof(Mark) == 32);
static_assert(sizeof(ShowConstants) == 64);
static_assert(sizeof(ViewConstants) == 176);
static_assert(sizeof(SurfaceConstants) == 80 + 32 * textureSlotCount);
static_assert(sizeof(DrawConstants) == 80);
static_assert(sizeof(LightConstants) == 144);
static_assert(sizeof(ShadowLayer) == 96);
static_assert(sizeof(TransmissionConstants) == 32 + 16 * (throughSteps + 1));
static_assert(sizeof(EnvironmentConstants) == 160);
} // namespace nacre::renderer::shared
#endif

#endif
