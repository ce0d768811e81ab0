#include "app/command_line.hpp"

#include "app/explain.hpp"
#include "app/process/console.hpp"
#include "app/process/exhaustion.hpp"
#include "app/run.hpp"
#include "app/version.hpp"
#include "core/error.hpp"
#include "core/machine/isa.hpp"
#include "input/case_reader.hpp"
#include "input/schema/nearest.hpp"
#include "input/schema/schema.hpp"
#include "report/materials.hpp"
#include "report/movie.hpp"
#include "report/report.hpp"
#include "results/output_folder.hpp"
#include "study/calibration.hpp"
#include "study/coefficients.hpp"
#include "study/compare.hpp"
#include "study/sweep.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <new>
#include <sstream>
#include <system_error>
#include <tuple>

namespace cnem::app {

namespace {

const CLI::Validator at_least_one(
    [](const std::string& given) {
      int number = 0;
      const char* end = given.data() + given.size();
      const bool whole = std::from_chars(given.data(), end, number).ptr == end;
      return whole && number >= 1 ? std::string()
                                  : fmt::format("found {}, expected a whole number from 1 to {}", given,
                                                std::numeric_limits<int>::max());
    },
    "POSITIVE");

/// Throws InputError that names the cases in a folder that is none itself.
void refuse_folder_of_cases(const std::filesystem::path& folder) {
  std::vector<std::string> cases;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (std::filesystem::exists(entry.path() / "case.toml"))
      cases.push_back(entry.path().filename().string());
  if (cases.empty()) return;
  std::sort(cases.begin(), cases.end());
  throw InputError(fmt::format("{} holds no case.toml itself, expected a case, one of its folders {}",
                               folder.string(), fmt::join(cases, ", ")));
}

/// What commands that read a case share.
struct CaseOptions {
  std::string path;
  std::vector<std::string> set;
  std::string output;
  bool force = false;
  int threads = 0;

  void declare_case(CLI::App& command) {
    command.add_option("case", path, "case file (TOML), or a folder that holds case.toml")->required();
    command.add_option("--set", set, "key=value: overrides a key of the case, e.g. --set time.end=\"60 us\"")
        ->allow_extra_args(false);
  }
  void declare(CLI::App& command, const char* folder = "folder of results (default: results/<case name>)",
               const char* forced = "replace a run that the folder holds") {
    declare_case(command);
    command.add_option("--output", output, folder);
    command.add_flag("--force", force, forced);
    command.add_option("--threads", threads, "number of threads (default: all)")->check(at_least_one);
  }
  std::filesystem::path file() const {
    const std::filesystem::path given = path;
    if (!std::filesystem::is_directory(given)) return given;
    if (!std::filesystem::exists(given / "case.toml")) refuse_folder_of_cases(given);
    return given / "case.toml";
  }
  input::Case read() const { return input::read_case(file(), set); }
  RunOptions options(const input::Case& input) const {
    return {.output = output.empty() ? std::filesystem::path("results") / input.name
                                     : std::filesystem::path(output),
            .force = force,
            .threads = threads,
            .version = version()};
  }
};

/// The library of materials, and one of them.
struct MaterialsCommand {
  CLI::App* all = nullptr;
  CLI::App* one = nullptr;
  bool markdown = false;
  std::string name, output;

  void declare(CLI::App& program) {
    all = program.add_subcommand("materials", "list the materials that a case can name");
    all->add_flag("--markdown", markdown, "print them with all their constants (docs/materials.md)");
    one = all->add_subcommand("show", "print a material: constants, units, sources, ranges");
    one->add_option("name", name, "of a material, such as 304L")->required();
    one->add_option("--output", output, "also write a page with flow curves into this file (HTML)");
  }
  void act() const {
    if (!*one) {
      fmt::print("{}", markdown ? report::materials_reference() : report::materials_list());
      return;
    }
    const input::LibraryMaterial material = input::library_material(name);
    if (!output.empty())
      results::write_atomically(output, report::render_report(report::material_report(material, version())));
    fmt::print("{}", report::material_text(material));
    if (!output.empty()) fmt::print("\npage: {}\n", output);
  }
};

/// Throws InputError when the first word is no command.
void check_command_name(const CLI::App& program, int argc, char** argv) {
  if (argc > 1 && argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  const std::string found = argc > 1 ? argv[1] : "";
  if (std::find(names.begin(), names.end(), found) != names.end()) return;
  throw InputError(fmt::format("{}expected a command, one of {}{}; `cnem --help` says what they do",
                               found.empty() ? "" : fmt::format("found '{}', ", found),
                               fmt::join(names, ", "), input::did_you_mean(found, names)));
}

/// A film of a run.
struct MovieCommand {
  CLI::App* command = nullptr;
  report::MovieOptions options;
  std::string from, to;

  void declare(CLI::App& program) {
    command = program.add_subcommand("movie", "make a film of a run's fields: GIF, WebP or MP4");
    command->add_option("folder", options.folder, "folder of results")->required();
    command->add_option("--field", options.field,
                        "field shown (default: the first of output.picture_fields)");
    command->add_option("--window", options.window, "one of output.windows (default: the whole)");
    command->add_option("--output", options.output,
                        "film, which ends in .gif, .webp or .mp4 (default: FIELD.gif in the folder)");
    command->add_option("--fps", options.frames_per_second, "frames a second (default: 10)")
        ->check(CLI::Range(0.1, 50.0));
    command->add_option("--width", options.width, "pixels (default: 800)")->check(CLI::Range(300, 4000));
    command->add_option("--from", from, "first time, e.g. \"10 us\"");
    command->add_option("--to", to, "last time");
    command->add_flag("--mirror", options.mirror, "draw halves and quarters whole");
  }
  void act() {
    for (const auto& [text, name, time] :
         {std::tuple(&from, "--from", &options.from), std::tuple(&to, "--to", &options.to)}) {
      if (text->empty()) continue;
      try {
        *time = input::parse_quantity(*text, input::dimension::time);
      } catch (const input::UnitError& error) { throw InputError(fmt::format("{}: {}", name, error.what())); }
    }
    fmt::print("{}\n", report::make_movie(options).string());
  }
};

void print_check(const input::Case& input, const RunOptions& options) {
  for (const auto& [name, text] : variable_texts(input)) fmt::print("variable    {} = {}\n", name, text);
  const Checked checked = check(input, options);
  for (const std::string& warning : checked.warnings) fmt::print("warning: {}\n", warning);
  for (const auto& [label, text] : checked.facts) fmt::print("{:<11} {}\n", label, text);
  if (!checked.fault.empty()) throw InputError(checked.fault);
}

int act(CLI::App& program, int argc, char** argv) {
  program.set_version_flag("--version", fmt::format("cnem {}", version()));
  program.require_subcommand(1);

  CaseOptions run_options, check_options;
  CLI::App* run_command = program.add_subcommand("run", "run a case");
  run_options.declare(*run_command);
  bool profile = false;
  run_command->add_flag("--profile", profile, "print where the time went, phase by phase");
  CLI::App* check_command = program.add_subcommand(
      "check", "build a case without running it: nodes, first step, overlap, initial fields");
  check_options.declare(*check_command);
  CLI::App* explain_command =
      program.add_subcommand("explain", "say in plain words what a case does, and what a run of it takes");
  CaseOptions explain_options;
  explain_options.declare_case(*explain_command);
  CLI::App* restart_command = program.add_subcommand(
      "restart", "go on with a run that was stopped or killed, from its last checkpoint");
  RunOptions restart_options;
  restart_command->add_option("folder", restart_options.output, "folder of results")->required();
  restart_command->add_option("--threads", restart_options.threads, "number of threads (default: all)")
      ->check(at_least_one);
  CLI::App* schema_command = program.add_subcommand("schema", "print the JSON Schema of case files");
  bool markdown = false;
  schema_command->add_flag("--markdown", markdown,
                           "print the case reference instead (docs/case_reference.md)");
  MaterialsCommand materials;
  materials.declare(program);
  CLI::App* report_command =
      program.add_subcommand("report", "write report.html anew from the files of a run");
  std::string folder;
  report_command->add_option("folder", folder, "folder of results")->required();

  MovieCommand movie;
  movie.declare(program);

  CLI::App* sweep_command = program.add_subcommand("sweep", "run a parameter study: one case, many values");
  std::string study_path, sweep_output;
  study::BatchOptions sweep_options;
  sweep_command->add_option("study", study_path, "study file (TOML), or a folder that holds study.toml")
      ->required();
  sweep_command->add_option("--output", sweep_output, "folder of results (default: results/<study name>)");
  sweep_command->add_flag("--force", sweep_options.force, "run all again, also what is done");
  sweep_command
      ->add_option("--processes", sweep_options.processes, "runs at a time (default: as the study says)")
      ->check(at_least_one);
  std::string only;
  CLI::Option* only_option = sweep_command->add_option(
      "--only", only, "K/N: run part K of N, for several machines and one folder (docs/clusters.md)");
  bool merge = false;
  sweep_command
      ->add_flag("--merge", merge, "write the table and the report of the runs that are there, run nothing")
      ->excludes(only_option)
      ->excludes("--force")
      ->excludes("--processes");

  CLI::App* calibrate_command = program.add_subcommand(
      "calibrate", "find constants that bring computed curves to measured ones (docs/experiments.md)");
  std::string calibration_path, calibration_output;
  study::BatchOptions calibration_options;
  calibrate_command
      ->add_option("calibration", calibration_path,
                   "file of parameters with bounds, and of targets (TOML), or a folder that holds "
                   "calibration.toml")
      ->required();
  calibrate_command->add_option(
      "--output", calibration_output,
      "folder of results (default: results/<calibration name>); the same command goes "
      "on with what it holds");
  calibrate_command->add_flag("--force", calibration_options.force, "run all again, also what is done");
  calibrate_command
      ->add_option("--processes", calibration_options.processes,
                   "runs at a time (default: as the calibration says, else one for each core)")
      ->check(at_least_one);

  CLI::App* coefficients_command = program.add_subcommand(
      "coefficients", "make a cutting law of a finished sweep of orthogonal cuts (docs/cutting.md)");
  std::string cuts_folder;
  coefficients_command->add_option("folder", cuts_folder, "folder of results of a sweep; law.toml goes there")
      ->required();

  CLI::App* compare_command =
      program.add_subcommand("compare", "run a case with several methods and lay their results side by side");
  CaseOptions compare_options;
  compare_options.declare(*compare_command, "folder of results (default: results/<case name>_compare)",
                          "run all again, also what is done");
  std::string methods;
  std::vector<std::pair<std::string, std::string>> set_for;
  compare_command->add_option("--methods", methods, "names of methods, e.g. --methods cnem,fe-triangles,sph")
      ->required();
  compare_command
      ->add_option("--set-for", set_for,
                   "METHOD key=value: overrides a key for one of the methods, e.g. --set-for fe-triangles "
                   "method.lagrangian=total")
      ->allow_extra_args(false);

  for (CLI::App* command : {run_command, check_command, explain_command, restart_command, sweep_command,
                            calibrate_command, compare_command})
    command->footer("CNEM_ISA=baseline, avx2 or avx512 in the environment chooses the instruction set of the "
                    "kernels (default: the best one that the machine has).");

  check_command_name(program, argc, argv);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, problems;
    const int code = program.exit(error, out, problems);
    fmt::print("{}", out.str());
    fmt::print(stderr, "{}", problems.str());
    return code == 0 ? Exit::done : Exit::bad_input;
  }
  if (!*schema_command && !*report_command && !*movie.command && !*materials.all)
    wanted_isa(); // a mistake in it shows before anything is made
  if (*run_command) {
    const input::Case input = run_options.read();
    RunOptions options = run_options.options(input);
    options.profile = profile;
    Console console;
    return run(input, options, console);
  }
  if (*restart_command) {
    restart_options.version = version();
    Console console;
    return restart(restart_options, console);
  }
  if (*sweep_command) {
    const study::Study study = study::read_study(study_path);
    sweep_options.output = sweep_output.empty() ? std::filesystem::path("results") / study.name
                                                : std::filesystem::path(sweep_output);
    sweep_options.version = version();
    if (!only.empty()) sweep_options.only = study::read_part(only);
    return study::sweep(study, sweep_options, merge ? study::SweepWork::merge : study::SweepWork::run);
  }
  if (*calibrate_command) {
    const study::Calibration calibration = study::read_calibration(calibration_path);
    calibration_options.output = calibration_output.empty()
                                     ? std::filesystem::path("results") / calibration.name
                                     : std::filesystem::path(calibration_output);
    calibration_options.version = version();
    return study::calibrate(calibration, calibration_options);
  }
  if (*coefficients_command) return study::coefficients(cuts_folder, version());
  if (*compare_command) {
    const study::Comparison comparison{.case_file = compare_options.file(),
                                       .methods = methods,
                                       .set = compare_options.set,
                                       .set_for = set_for,
                                       .threads = compare_options.threads};
    return study::compare(comparison,
                          {.output = compare_options.output.empty()
                                         ? std::filesystem::path("results") /
                                               (input::name_after(comparison.case_file, "case") + "_compare")
                                         : std::filesystem::path(compare_options.output),
                           .force = compare_options.force,
                           .version = version()});
  }
  if (*check_command) {
    const input::Case input = check_options.read();
    print_check(input, check_options.options(input));
  } else if (*explain_command) {
    fmt::print("{}", explanation(explain_options.read()));
  } else if (*schema_command) {
    fmt::print("{}", markdown ? input::case_reference() : input::json_schema());
  } else if (*materials.all) {
    materials.act();
  } else if (*report_command) {
    fmt::print("{}\n", report::write_report(folder).string());
  } else if (*movie.command) {
    movie.act();
  }
  return Exit::done;
}

} // namespace

int command_line(int argc, char** argv) {
  CLI::App program("Blanking, shearing and cutting of metal by the constrained natural element method",
                   "cnem");
  try {
    return act(program, argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return Exit::bad_input;
  } catch (const DivergenceError& error) {
    fmt::print(stderr, "diverged: {}\n", error.what());
    return Exit::diverged;
  } catch (const IoError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return Exit::io_failed;
  } catch (const std::system_error& error) { // files, threads and processes
    fmt::print(stderr, "{}\n", error.what());
    return Exit::io_failed;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "{}\n", memory_exhausted());
    return Exit::io_failed;
  }
}

} // namespace cnem::app
