// `nacre material fit`.
#pragma once

namespace CLI {
class App;
} // namespace CLI

namespace nacre::app {

/// Adds `fit` to the subcommands of `nacre material`.
void addMaterialFit(CLI::App& material);

} // namespace nacre::app
