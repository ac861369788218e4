// A scene in memory: what the importers, the scene files and the gallery produce and what the renderer draws.
// Right-handed, +Y up, metres after `metersPerUnit`; colours linear Rec.709.
#pragma once

#include "image/image.hpp"
#include "nacre/files.hpp"
#include "nacre/material.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nacre::scene {

/// What is wrong with a file: one sentence that names the file, the field and the value.
using SceneError = FileError;

inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

struct Vertex {
    glm::vec3 position{0};
    glm::vec3 normal{0, 1, 0};
    glm::vec4 tangent{1, 0, 0, 1}; ///< w is the bitangent's sign, as in glTF
    glm::vec2 uv{0};
    glm::vec<4, std::uint16_t> color{65535}; ///< multiplies the surface's base colour: linear, 65535 = 1
    glm::vec2 secondUv{0};                   ///< for textures whose TextureCoordinates say so
};

/// Indexed triangles with one surface.
struct Mesh {
    std::string name;
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices; ///< three a triangle
    std::uint32_t surface = 0;          ///< index into Scene::surfaces
};

/// What a texture shows outside [0, 1].
enum class Wrap { Repeat, Mirror, Clamp };

/// 8-bit RGBA pixels, row 0 at the top.
struct Texture {
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    bool srgb = false;
    Wrap wrapU = Wrap::Repeat;
    Wrap wrapV = Wrap::Repeat;
    bool nearest = false;             ///< magnified without blending texels
    std::vector<std::uint8_t> pixels; ///< width·height·4 bytes
};

/// What the alpha of a surface's base colour does, as in glTF.
enum class AlphaMode {
    Opaque, ///< nothing
    Mask,   ///< what is below the cutoff is not there
    Blend   ///< the surface lets through what is behind it; it has no subsurface scattering
};

/// Alpha from which a blended surface throws a shadow, a full one: just above a half, where none is as far from the
/// truth.
inline constexpr float blendedShadowCutoff = 0.5f + std::numeric_limits<float>::epsilon();

/// Where on its vertices' texture coordinates a texture lies.
struct TextureCoordinates {
    glm::mat3 transform{1}; ///< KHR_texture_transform, applied to uv
    bool second = false;    ///< of Vertex::secondUv in place of Vertex::uv

    const glm::vec2& of(const Vertex& vertex) const { return second ? vertex.secondUv : vertex.uv; }
    bool operator==(const TextureCoordinates&) const = default;
};

/// [1] Bounds of a surface's scale in any place, as the effect has them (NacreScatterInfo::scale).
inline constexpr float leastScale = 1e-3f;
inline constexpr float largestScale = 1e3f;

/// How a surface looks apart from its subsurface material.
struct Surface {
    std::string name;
    glm::vec4 baseColor{0.8f, 0.8f, 0.8f, 1};
    float metallic = 0;     ///< [0, 1]
    float roughness = 0.5f; ///< [0, 1]
    float specular = 0.5f;  ///< [0, 1] F0 = 0.08·specular
    float normalScale = 1;
    glm::vec3 emission{0};
    std::uint32_t baseColorTexture = none;
    std::uint32_t normalTexture = none;
    std::uint32_t metallicRoughnessTexture = none; ///< G roughness, B metallic
    std::uint32_t thicknessTexture = none;         ///< G, multiplies `thickness`
    std::uint32_t emissionTexture = none;          ///< RGB, multiplies `emission`
    std::uint32_t scaleTexture = none;             ///< R, linear, multiplies `scale`
    std::uint32_t transmissionTexture = none;      ///< A, multiplies the share of the light that comes through
    /// RGB, the colour of the light that comes through: multiplies the material's diffuseTransmissionColor, or stands
    /// in for the albedo where there is none. Of thin walls and bodies alike.
    std::uint32_t transmissionColorTexture = none;
    TextureCoordinates baseColorUv;
    TextureCoordinates normalUv;
    TextureCoordinates metallicRoughnessUv;
    TextureCoordinates thicknessUv;
    TextureCoordinates emissionUv;
    TextureCoordinates scaleUv;
    TextureCoordinates transmissionUv;
    TextureCoordinates transmissionColorUv;
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f; ///< [≥ 0] of AlphaMode::Mask
    bool doubleSided = false;
    /// [≥ 0] mm; bounds the shadow-map thickness, or stands in for it. Negative: none authored.
    float thickness = -1;
    /// Multiplies the lengths of the material's profile; with its texture [leastScale, largestScale] counts, values
    /// beyond as those.
    float scale = 1;
    /// The transmission texture multiplies the material's strength, too: what does not enter leaves unscattered.
    bool transmissionSetsStrength = false;
    /// Index into Scene::materials; `none` = no subsurface scattering.
    std::uint32_t material = none;
    /// Which of a scene file's `models` brought it; 0 where the scene is of one model.
    std::uint32_t model = 0;
};

/// A texture of a surface and where it lies.
struct TextureSlot {
    std::uint32_t Surface::*texture;
    TextureCoordinates Surface::*coordinates;
};

/// All that a surface has.
inline constexpr std::array textureSlots{
    TextureSlot{&Surface::baseColorTexture, &Surface::baseColorUv},
    TextureSlot{&Surface::normalTexture, &Surface::normalUv},
    TextureSlot{&Surface::metallicRoughnessTexture, &Surface::metallicRoughnessUv},
    TextureSlot{&Surface::thicknessTexture, &Surface::thicknessUv},
    TextureSlot{&Surface::emissionTexture, &Surface::emissionUv},
    TextureSlot{&Surface::scaleTexture, &Surface::scaleUv},
    TextureSlot{&Surface::transmissionTexture, &Surface::transmissionUv},
    TextureSlot{&Surface::transmissionColorTexture, &Surface::transmissionColorUv}};

struct Instance {
    std::string name;
    std::uint32_t mesh = 0;
    glm::mat4 transform{1};
};

enum class LightKind { Directional, Spot, Point };

/// A punctual light (KHR_lights_punctual).
struct Light {
    std::string name;
    LightKind kind = LightKind::Directional;
    glm::vec3 color{1};
    float intensity = 1; ///< directional: lux-like irradiance; spot and point: irradiance at one metre
    glm::vec3 position{0};
    glm::vec3 direction{0, -1, 0}; ///< the way the light travels
    float range = 0;               ///< [m] 0 = unlimited
    float innerConeAngle = 0;      ///< [rad] half angles
    float outerConeAngle = 0.7853982f;
    bool castsShadow = true;
};

enum class ProjectionKind { Perspective, Orthographic };

struct Camera {
    std::string name;
    glm::vec3 position{0, 0, 1};
    glm::vec3 target{0};
    glm::vec3 up{0, 1, 0};
    ProjectionKind projection = ProjectionKind::Perspective;
    float verticalFieldOfView = 0.6f; ///< [rad] perspective
    float orthographicHeight = 1;     ///< [units] orthographic
    glm::vec2 offCenter{0};           ///< shift of the principal point in half images: 1 = to the edge
    float nearPlane = 0;              ///< 0 = fitted to the scene
    float farPlane = 0;               ///< 0 = fitted to the scene
};

/// Image-based light: an equirectangular image, or the built-in sky when there is none.
struct Environment {
    std::optional<Image> image; ///< linear, 4 channels RGBA, alpha unused
    std::string file;           ///< that the image was read from
    float intensity = 1;
    float rotation = 0; ///< [rad] about +Y
    glm::vec3 zenith{0.25f, 0.32f, 0.45f};
    glm::vec3 horizon{0.55f, 0.55f, 0.55f};
    glm::vec3 ground{0.18f, 0.16f, 0.14f};
};

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;
    std::vector<Texture> textures;
    std::vector<Surface> surfaces;
    std::vector<Instance> instances;
    std::vector<Material> materials;
    std::vector<Light> lights;   ///< those in use
    std::vector<Camera> cameras; ///< the first is the default
    Environment environment;
    double metersPerUnit = 1;
    /// [units] Where the scene's origin is in the coordinates of its file, of a model that stands far from its own.
    glm::dvec3 origin{0};
    float exposure = 1;
    /// Files that were read for it beside the one that was asked for: no output may replace them.
    std::vector<std::string> inputs;
    /// What an importer had to leave out or simplify, a sentence each, beginning with the file.
    std::vector<std::string> notes;
};

struct Bounds {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};
    glm::vec3 center() const { return 0.5f * (low + high); }
    float radius() const { return 0.5f * glm::length(high - low); }
};

/// Bounds of all instances in scene units, a little wide of very many (outline.hpp); an empty scene throws SceneError.
Bounds bounds(const Scene& scene);

/// Triangles over all instances.
std::uint64_t triangleCount(const Scene& scene);

} // namespace nacre::scene
