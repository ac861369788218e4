// A developer build's renderer: shaders of its own and of the effect are changed and broken in a copy of the project,
// and the next picture shows it.
#include "tests/gpu/support/project_copy.hpp"
#include "tests/gpu/support/renderer_scenes.hpp"

namespace nacre::tests {
namespace {

using renderer::Offscreen;
using renderer::Output;
using renderer::Pixels;

class Reload : public RendererTest {};

/// A dull ground of one material that a light shines on, so that all of it has the same light.
scene::Scene litGround() {
    scene::Scene scene = darkScene(2);
    scene.materials = {{.name = "wax", .description = {}, .layers = {{.weight = {1, 1, 1}, .variance = 40}}}};
    scene::Surface& ground = add(scene, square(4));
    ground.material = 0;
    ground.specular = 0;
    scene.lights = {directional({0, 0, -1})};
    return scene;
}

TEST_F(Reload, DrawsWithChangedShadersAndKeepsThePictureWhereOneIsBroken) {
    const ProjectCopy project({"app", "bake", "bench", "cmake", "core", "developer", "effect", "image", "include",
                               "reference", "renderer", "scene", "trace", "view"},
                              "-DNACRE_BUILD_APP=ON");
    const std::string scatter = "effect/separable/scatter_separable.comp";
    const std::string compose = "renderer/passes/compose_picture.comp";
    const scene::Scene scene = litGround();
    renderer::RenderSettings settings = plainSettings();
    settings.scatter = true;
    settings.technique = NACRE_TECHNIQUE_SEPARABLE;
    Offscreen offscreen(device(), scene, settings);
    const auto draw = [&](Output output) {
        offscreen.render(scene.cameras[0]);
        return offscreen.read(output);
    };
    const auto middle = [](const Pixels& pixels) { return at(pixels, pixels.width / 2, pixels.height / 2); };
    const Pixels before = draw(Output::Radiance);
    const float scattered = middle(draw(Output::Scattered));
    EXPECT_NEAR(scattered, 1, 1e-2f);

    project.change(scatter, "return light / max(weight,", "return 0.5 * light / max(weight,");
    project.change(compose, "min(radiance,", "min(0.5 * radiance,");
    offscreen.reloadShaders();
    EXPECT_NEAR(middle(draw(Output::Scattered)), 0.25f * scattered, 1e-3f) << "along rows and columns";
    const Pixels changed = draw(Output::Radiance);
    EXPECT_NEAR(middle(changed), 0.125f * middle(before), 1e-3f);

    project.change(compose, "0.5 * radiance", "0.5 * radience");
    try {
        offscreen.reloadShaders();
        ADD_FAILURE() << "a shader that does not compile was loaded";
    } catch (const renderer::RendererError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("compose_picture.comp"), std::string::npos) << message;
        EXPECT_NE(message.find("'radience' : undeclared identifier"), std::string::npos) << message;
    }
    EXPECT_EQ(draw(Output::Radiance).values, changed.values);

    project.change(compose, "0.5 * radience", "radiance");
    project.change(scatter, "0.5 * light", "light");
    offscreen.reloadShaders();
    EXPECT_EQ(draw(Output::Radiance).values, before.values);
}

} // namespace
} // namespace nacre::tests
