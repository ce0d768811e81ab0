#include "study/sweep.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/machine/threads.hpp"
#include "input/case_reader.hpp"
#include "input/schema/nearest.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/folder_lock.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"
#include "study/process_pool.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace cnem::study {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using State = SweepRun::State;

constexpr const char* manifest_file = "manifest.json";

/// FNV-1a, 64 bits.
std::string hash(std::string_view text) {
  std::uint64_t h = 0xcbf29ce484222325U;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return fmt::format("{:016x}", h);
}

/// What a run depends on: the resolved case without its first line, which names the file, and the nodes,
/// which may come from a file of their own.
std::string inputs_of(const input::Case& input) {
  std::string text = input.resolved.substr(input.resolved.find('\n') + 1);
  for (const Vec2& node : input.cloud.nodes) text += fmt::format("{:a} {:a}\n", node.x(), node.y());
  return hash(text);
}

/// Reads the case of every run, so that a mistake in the last one shows before the first one starts.
std::vector<SweepRun> read_cases(const Study& study) {
  std::vector<SweepRun> runs;
  for (const StudyRun& run : study.runs) {
    try {
      runs.emplace_back().inputs = inputs_of(input::read_case_with(study.case_file.string(), run.changes()));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}\nin run '{}' of the study", error.what(), run.name));
    }
  }
  return runs;
}

void prepare_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder))
    throw IoError(fmt::format("cannot create the output folder {}: {}", folder.string(),
                              error ? error.message() : "a file of this name is in the way"));
  if (fs::exists(folder / results::files::status))
    throw InputError(fmt::format("the output folder {} holds a single run: choose another with --output",
                                 folder.string()));
}

std::string manifest(const Study& study, const std::vector<SweepRun>& runs, const std::string& version) {
  Json json{{"study", study.name}, {"case", study.case_file.string()}, {"version", version}};
  json["runs"] = Json::array();
  for (std::size_t k = 0; k < runs.size(); ++k) {
    Json set = Json::object();
    for (const input::Override& change : study.runs[k].changes()) set[change.key] = plain_text(change.value);
    Json run{{"name", study.runs[k].name}, {"set", set}, {"inputs", runs[k].inputs}};
    run["state"] = runs[k].state == State::done     ? "done"
                   : runs[k].state == State::failed ? "failed"
                                                    : "pending";
    if (runs[k].state == State::failed) {
      run["exit"] = runs[k].exit;
      run["reason"] = runs[k].reason;
    }
    json["runs"].push_back(std::move(run));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// The status of a run that ended well; none for others.
std::optional<results::RunStatus> good_status(const fs::path& folder) {
  if (!fs::exists(folder / results::files::status)) return {};
  try {
    results::RunStatus status = results::read_status(folder);
    if (status.exit == Exit::done) return status;
  } catch (const IoError&) {} // half a status is none: the run is done again
  return {};
}

/// Whether a run that an earlier sweep has not done did not come to its own end either.
bool was_interrupted(const Json& old) {
  if (old.at("state") != "failed") return true;
  const int exit = old.at("exit");
  return exit != Exit::bad_input && exit != Exit::diverged;
}

/// Marks the runs that an earlier sweep has done, or begun, with the same inputs.
void find_earlier(const Study& study, std::vector<SweepRun>& runs, const fs::path& folder) {
  const fs::path path = folder / manifest_file;
  if (!fs::exists(path)) return;
  try {
    const Json json = Json::parse(results::read_file(path));
    for (const Json& old : json.at("runs"))
      for (std::size_t k = 0; k < runs.size(); ++k) {
        if (old.at("name") != study.runs[k].name || old.at("inputs") != runs[k].inputs) continue;
        const fs::path own = folder / study.runs[k].name;
        if (old.at("state") == "done") {
          if ((runs[k].status = good_status(own))) runs[k].state = State::done;
        } else {
          runs[k].interrupted = was_interrupted(old) && fs::exists(own / results::files::resolved_case) &&
                                !results::list_checkpoints(own).empty();
        }
      }
  } catch (const Json::exception& error) {
    throw IoError(fmt::format("{} is not the manifest of a sweep ({}): run all again with --force",
                              path.string(), error.what()));
  }
}

std::string last_line(const fs::path& log) {
  std::string text = results::read_file(log);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

void conclude(SweepRun& run, const JobEnd& end, const fs::path& folder, const fs::path& log) {
  run.exit = end.code;
  run.status = end.code == Exit::done ? good_status(folder) : std::nullopt;
  run.state = run.status ? State::done : State::failed;
  if (run.status) return;
  if (end.signal != 0)
    run.reason = fmt::format("killed by signal {}", end.signal);
  else if (fs::exists(folder / results::files::status))
    run.reason = results::read_status(folder).reason;
  else
    run.reason = last_line(log);
  if (run.reason.empty()) run.reason = fmt::format("ended with code {} and no message", end.code);
}

fs::path log_of(const fs::path& folder) { return folder.string() + ".log"; }

std::vector<std::string> command(const Study& study, std::size_t k, bool interrupted, const fs::path& folder,
                                 const SweepOptions& options) {
  std::vector<std::string> words{options.program.string()};
  if (interrupted) {
    words.insert(words.end(), {"restart", folder.string()});
  } else {
    words.insert(words.end(), {"run", study.case_file.string(), "--output", folder.string(), "--force"});
    for (const input::Override& change : study.runs[k].changes())
      words.insert(words.end(), {"--set", change.key + "=" + input::toml_text(change.value)});
  }
  words.insert(words.end(), {"--threads", std::to_string(study.threads)});
  return words;
}

std::size_t processes_for(const Study& study, const SweepOptions& options) {
  const int wanted = options.processes > 0 ? options.processes : study.processes;
  if (wanted > 0) return index_of(wanted);
  return std::max<std::size_t>(1, std::thread::hardware_concurrency() / index_of(study.threads));
}

/// Columns and charts that name what no run has.
void warn_of_absent_numbers(const Study& study, const std::vector<SweepRun>& runs) {
  std::vector<std::string> wanted = study.columns, there;
  for (const StudyChart& chart : study.charts) wanted.insert(wanted.end(), chart.y.begin(), chart.y.end());
  bool any = false;
  for (const SweepRun& run : runs) {
    if (!run.status) continue;
    any = true;
    for (const auto& [name, value] : run.status->metrics) there.push_back("metrics." + name);
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  for (const std::string& name : wanted)
    if (any && std::none_of(runs.begin(), runs.end(), [&](const SweepRun& run) {
          return run.status && status_number(*run.status, name);
        }))
      fmt::print(stderr, "warning: no run has '{}'{}\n", name, input::did_you_mean(name, there));
}

} // namespace

Exit sweep(const Study& study, const SweepOptions& options) {
  check_threads(study.threads, "threads of the study");
  std::vector<SweepRun> runs = read_cases(study);
  prepare_folder(options.output);
  const results::FolderLock lock(options.output, "sweep");
  if (!options.force) find_earlier(study, runs, options.output);
  const auto write_manifest = [&] {
    results::write_atomically(options.output / manifest_file, manifest(study, runs, options.version));
  };
  std::vector<Job> jobs;
  std::vector<std::size_t> run_of;
  std::size_t restarts = 0;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].state == State::done) continue;
    const fs::path folder = options.output / study.runs[k].name;
    restarts += runs[k].interrupted;
    // What the folder holds must not be taken for a run with the inputs that the manifest will name.
    if (!runs[k].interrupted) fs::remove(folder / results::files::resolved_case);
    jobs.push_back({command(study, k, runs[k].interrupted, folder, options), log_of(folder)});
    run_of.push_back(k);
  }
  write_manifest();
  const std::size_t processes =
      std::min(processes_for(study, options), std::max<std::size_t>(1, jobs.size()));
  fmt::print("{} runs: {} done before, {} to do in {} processes{}\n", runs.size(), runs.size() - jobs.size(),
             jobs.size(), processes,
             restarts > 0 ? fmt::format(", {} from the last checkpoint", restarts) : "");
  std::fflush(stdout);

  using Clock = std::chrono::steady_clock;
  std::vector<Clock::time_point> began(runs.size());
  std::size_t finished = runs.size() - jobs.size();
  const bool complete = run_jobs(
      jobs, processes,
      [&](std::size_t job) {
        began[run_of[job]] = Clock::now();
        // A status left by an earlier run must not speak for this one.
        fs::remove(options.output / study.runs[run_of[job]].name / results::files::status);
      },
      [&](std::size_t job, JobEnd end) {
        const std::size_t k = run_of[job];
        conclude(runs[k], end, options.output / study.runs[k].name, jobs[job].log);
        write_manifest();
        const double seconds = std::chrono::duration<double>(Clock::now() - began[k]).count();
        const std::string what = runs[k].status ? fmt::format("done, {} nodes", runs[k].status->nodes)
                                                : "FAILED: " + runs[k].reason;
        fmt::print("[{}/{}] {}: {}, {}\n", ++finished, runs.size(), study.runs[k].name, what,
                   results::duration_format(seconds));
        std::fflush(stdout);
      });

  results::write_atomically(options.output / "table.csv", sweep_table(study, runs));
  const fs::path report = options.output / results::files::report;
  results::write_atomically(report, sweep_report(study, runs, options.output, options.version));
  warn_of_absent_numbers(study, runs);
  bool failed = false;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].state != State::failed) continue;
    failed = true;
    fmt::print(stderr, "failed: {}: {} (exit code {}, log {})\n", study.runs[k].name, runs[k].reason,
               runs[k].exit, log_of(options.output / study.runs[k].name).string());
  }
  fmt::print("table: {}\nreport: {}\n", (options.output / "table.csv").string(), report.string());
  if (!complete) {
    fmt::print(stderr, "interrupted: {} of {} runs ended; the same command goes on from here\n", finished,
               runs.size());
    return Exit::interrupted;
  }
  return failed ? Exit::diverged : Exit::done;
}

} // namespace cnem::study
