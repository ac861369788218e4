// The command `nacre`: parses, runs one subcommand, and turns what went wrong into one sentence and an exit code.
#include "app/command.hpp"
#include "app/terminal_text.hpp"

#include <CLI/CLI.hpp>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <new>

namespace {

constexpr int success = 0;
constexpr int failure = 1;
constexpr int wrongUsage = 2;

constexpr const char* examples = R"(Examples:
  nacre render -o gallery.png                           the built-in gallery
  nacre render model.glb --material skin --back         any model, lit from behind
  nacre render scene.json -o frame.exr --json frame.json
  nacre reference model.glb -o truth.exr                what the picture should be
  nacre bake thickness model.glb -o T.png               how thick it is, as a texture
  nacre compare frame.exr reference.exr                 how far a picture is from another
  nacre material list                                   what there is to render with
  nacre view model.glb                                  a window to build materials in
  nacre devices                                         what there is to render on
`nacre COMMAND --help` tells the rest.)";

int complain(const std::string& sentence, int exitCode) {
    std::cerr << "nacre: " << nacre::app::printable(sentence) << '\n';
    return exitCode;
}

/// What the standard library says of files in its own words, as a sentence.
std::string sentenceOf(const std::filesystem::filesystem_error& error) {
    return error.path1().string() + ": " + error.code().message();
}

/// "nacre render", for the hint where to read on.
std::string commandLine(const CLI::App& app) {
    std::string result = app.get_name();
    for (const CLI::App* command = &app; !command->get_subcommands().empty();) {
        command = command->get_subcommands().front();
        result += ' ' + command->get_name();
    }
    return result;
}

/// An option given an empty value is a mistake of the script that calls us, not an option left out.
void refuseEmptyValues(CLI::App& app) {
    for (CLI::Option* option : app.get_options()) {
        option->check(CLI::Validator(
            [](std::string& value) { return value.empty() ? "the value is empty" : std::string(); }, ""));
    }
    for (CLI::App* command : app.get_subcommands({})) {
        refuseEmptyValues(*command);
    }
}

int run(CLI::App& app, int argumentCount, char** arguments) {
    try {
        app.parse(argumentCount, arguments);
        if (app.get_subcommands().empty()) {
            std::cout << app.help();
        }
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
            app.exit(error);
        } else {
            return complain(std::string(error.what()) + " (see `" + commandLine(app) + " --help`)", wrongUsage);
        }
    }
    std::cout.flush();
    if (!std::cout) {
        throw std::runtime_error("cannot write to standard output");
    }
    return success;
}

} // namespace

int main(int argumentCount, char** arguments) {
    std::signal(SIGXFSZ, SIG_IGN); // so that writing too large a file fails with a reason
    try {
        CLI::App app("Nacre renders light that travels under a surface: skin, marble, wax, jade, leaves.", "nacre");
        app.set_version_flag("--version", "nacre " NACRE_VERSION);
        app.footer(examples);
        nacre::app::addRender(app);
        nacre::app::addReference(app);
        nacre::app::addBake(app);
        nacre::app::addCompare(app);
        nacre::app::addMaterial(app);
        nacre::app::addDevices(app);
        nacre::app::addBench(app);
        nacre::app::addView(app);
        refuseEmptyValues(app);
        return run(app, argumentCount, arguments);
    } catch (const nacre::app::UsageError& error) {
        return complain(error.what(), wrongUsage);
    } catch (const std::bad_alloc&) {
        return complain("there is not enough memory for this", failure);
    } catch (const std::filesystem::filesystem_error& error) {
        return complain(sentenceOf(error), failure);
    } catch (const std::exception& error) {
        return complain(error.what(), failure);
    }
}
