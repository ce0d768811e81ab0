#include "study/batch.hpp"

#include "core/error.hpp"
#include "core/fnv.hpp"
#include "core/index.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/folder_lock.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"
#include "study/manifest.hpp"
#include "study/process_pool.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <map>
#include <thread>

namespace cnem::study {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using State = RunRecord::State;

constexpr const char* another_folder = "choose another with --output";

std::string hash(std::string_view text) { return fmt::format("{:016x}", fnv(text)); }

/// Throws InputError when the folder holds what another command, or a user, has made.
void check_folder(const Study& study, const fs::path& folder, const std::string& kind, bool force) {
  if (holds_manifest(folder, kind, force)) return;
  for (const StudyRun& run : study.runs)
    if (!force && results::holds_run(folder / run.name))
      throw InputError(fmt::format("{} holds a run that no {} has made: {}, or replace it with --force",
                                   (folder / run.name).string(), kind, another_folder));
}

/// Where a run stands, for later calls.
Json entry_of(const StudyRun& run, const RunRecord& record) {
  Json set = Json::object();
  for (const input::Override& change : run.changes()) set[change.key] = plain_text(change.value);
  Json entry{{"name", run.name}, {"set", set}, {"inputs", record.inputs}};
  entry["state"] = state_name(record.state);
  if (record.state == State::failed) entry["exit"] = record.exit;
  if (!record.reason.empty()) entry["reason"] = record.reason;
  return entry;
}

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string manifest_text(const Study& study, const std::vector<RunRecord>& runs, const std::string& kind,
                          const std::string& version) {
  Json json{{"kind", kind}, {"study", study.name}, {"case", study.case_file.string()}, {"version", version}};
  json["runs"] = Json::array();
  for (std::size_t k = 0; k < runs.size(); ++k) json["runs"].push_back(entry_of(study.runs[k], runs[k]));
  return json_text(json);
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

/// Whether a run that an earlier call has not done did not come to its own end either.
bool was_interrupted(const Json& old) {
  if (old.at("state") != state_name(State::failed)) return true;
  const int exit = old.at("exit");
  return exit != Exit::bad_input && exit != Exit::diverged;
}

/// What earlier calls have left of each run, by its name.
std::map<std::string, Json> earlier_entries(const fs::path& folder) {
  std::map<std::string, Json> entries;
  if (const std::optional<Json> manifest = read_manifest(folder))
    for (const Json& entry : entries_of(*manifest, folder)) entries[entry.at("name")] = entry;
  return entries;
}

/// Marks the runs that an earlier call has done, or begun, with the same inputs; and, where they shall not be
/// run again, those that failed.
void find_earlier(const Study& study, std::vector<RunRecord>& runs, const fs::path& folder,
                  const std::string& kind, bool failed_too = false) {
  try {
    const std::map<std::string, Json> entries = earlier_entries(folder);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const auto found = entries.find(study.runs[k].name);
      if (found == entries.end() || found->second.at("inputs") != runs[k].inputs ||
          runs[k].state == State::refused)
        continue;
      const Json& old = found->second;
      const fs::path own = folder / study.runs[k].name;
      if (old.at("state") == state_name(State::done)) {
        if ((runs[k].status = good_status(own))) runs[k].state = State::done;
      } else {
        runs[k].interrupted = was_interrupted(old) && fs::exists(own / results::files::resolved_case) &&
                              !results::list_checkpoints(own).empty();
      }
      if (failed_too && old.at("state") == state_name(State::failed)) {
        runs[k].state = State::failed;
        runs[k].exit = old.at("exit");
        runs[k].reason = old.value("reason", "");
      }
    }
  } catch (const Json::exception& error) {
    throw IoError(fmt::format("{} is not the manifest of a {} ({}): run all again with --force",
                              (folder / manifest_file).string(), kind, error.what()));
  }
}

void conclude(RunRecord& run, const JobEnd& end, const fs::path& folder, const fs::path& log) {
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

} // namespace

bool holds_manifest(const fs::path& folder, const std::string& kind, bool force) {
  if (fs::exists(folder / results::files::status))
    throw InputError(
        fmt::format("the output folder {} holds a single run: {}", folder.string(), another_folder));
  try {
    const std::optional<Json> manifest = read_manifest(folder);
    if (!manifest) return false;
    if (const std::string made = manifest->value("kind", "sweep"); made != kind)
      throw InputError(fmt::format("the output folder {} holds the runs of a {}, expected those of a {}: {}",
                                   folder.string(), made, kind, another_folder));
    return true;
  } catch (const Json::exception& error) {
    if (force) return true;
    throw IoError(fmt::format("{} is not the manifest of a {} ({}): run all again with --force",
                              (folder / manifest_file).string(), kind, error.what()));
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder))
    throw IoError(fmt::format("cannot create the output folder {}: {}", folder.string(),
                              error ? error.message() : "a file of this name is in the way"));
}

std::vector<std::string> run_command(const RunOrder& order, const fs::path& program) {
  std::vector<std::string> words{program.string()};
  if (order.interrupted) {
    words.insert(words.end(), {"restart", order.folder.string()});
  } else {
    words.insert(words.end(),
                 {"run", order.case_file.string(), "--output", order.folder.string(), "--force"});
    for (const input::Override& change : order.changes)
      words.insert(words.end(), {"--set", change.key + "=" + input::toml_text(change.value)});
  }
  if (order.threads > 0) words.insert(words.end(), {"--threads", std::to_string(order.threads)});
  return words;
}

fs::path log_of(const fs::path& folder) { return folder.string() + ".log"; }

std::string last_line(const fs::path& log) {
  std::string text = results::read_file(log);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

/// Writes table and report and tells what `pages` has to tell.
void write_pages(const std::vector<RunRecord>& runs, const fs::path& folder, const Pages& pages) {
  const PageTexts texts = pages.write(runs);
  results::write_atomically(folder / pages.table, texts.table);
  results::write_atomically(folder / pages.report, texts.report);
  for (const auto& [name, text] : texts.more) results::write_atomically(folder / name, text);
  if (pages.tell) pages.tell(runs);
}

void tell_pages(const fs::path& folder, const Pages& pages) {
  fmt::print("table: {}\nreport: {}\n", (folder / pages.table).string(), (folder / pages.report).string());
}

void tell_failure(const StudyRun& run, const RunRecord& record, const fs::path& folder) {
  fmt::print(stderr, "failed: {}: {} (exit code {}, log {})\n", run.name, record.reason, record.exit,
             log_of(folder / run.name).string());
}

std::size_t processes_for(int wanted, int threads) {
  if (wanted > 0) return index_of(wanted);
  return std::max<std::size_t>(1, std::thread::hardware_concurrency() / index_of(std::max(1, threads)));
}

const char* state_name(State state) {
  switch (state) {
  case State::done:
    return "done";
  case State::failed:
    return "failed";
  case State::refused:
    return "refused";
  case State::pending:
    break;
  }
  return "pending";
}

/// The first line of the resolved case names the file; nodes may come from a file of their own.
std::string inputs_of(const input::Case& input) {
  std::string text = input.resolved.substr(input.resolved.find('\n') + 1);
  for (const Vec2& node : input.cloud.nodes) text += fmt::format("{:a} {:a}\n", node.x(), node.y());
  return hash(text);
}

Exit run_batch(const Study& study, std::vector<RunRecord> runs, const BatchOptions& options,
               const Pages& pages) {
  check_folder(study, options.output, pages.kind, options.force);
  make_folder(options.output);
  using Use = results::FolderLock::Use;
  const results::FolderLock lock(options.output, pages.kind.c_str(), options.only ? Use::shared : Use::alone);
  if (!options.force) find_earlier(study, runs, options.output, pages.kind);
  const auto write_manifest = [&](const std::vector<RunRecord>& of) {
    results::write_atomically(options.output / manifest_file,
                              manifest_text(study, of, pages.kind, options.version));
  };
  const auto write_note = [&](std::size_t k) {
    results::write_atomically(note_of_part(options.output, study.runs[k].name),
                              json_text(entry_of(study.runs[k], runs[k])));
  };
  std::vector<std::size_t> own;
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (!options.only || options.only->holds(k)) own.push_back(k);
  const auto count = [&](State state) {
    return index_of(
        std::count_if(own.begin(), own.end(), [&](std::size_t k) { return runs[k].state == state; }));
  };
  for (const std::size_t k : own) // nothing is touched while somebody is at work on one of them
    if (const fs::path folder = options.output / study.runs[k].name;
        runs[k].state == State::pending && fs::is_directory(folder))
      const results::FolderLock free(folder, "run");
  std::vector<Job> jobs;
  std::vector<std::size_t> run_of;
  std::size_t restarts = 0;
  for (const std::size_t k : own) {
    if (runs[k].state == State::refused)
      fmt::print(stderr, "refused: {}: {}\n", study.runs[k].name, runs[k].reason);
    if (runs[k].state != State::pending) continue;
    const fs::path folder = options.output / study.runs[k].name;
    restarts += runs[k].interrupted;
    // What the folder holds must not be taken for a run with the inputs that the manifest will name.
    if (!runs[k].interrupted) fs::remove(folder / results::files::resolved_case);
    jobs.push_back({run_command({.case_file = study.case_file,
                                 .changes = study.runs[k].changes(),
                                 .folder = folder,
                                 .interrupted = runs[k].interrupted,
                                 .threads = study.threads},
                                options.program),
                    log_of(folder)});
    run_of.push_back(k);
  }
  if (options.only) {
    // All that a manifest says beside notes is whose folder it is.
    if (!fs::exists(options.output / manifest_file)) write_manifest({});
    for (const std::size_t k : run_of) write_note(k);
  } else {
    write_manifest(runs);
    for (const StudyRun& run : study.runs) fs::remove(note_of_part(options.output, run.name));
  }
  const std::size_t processes =
      std::min(processes_for(options.processes > 0 ? options.processes : study.processes, study.threads),
               std::max<std::size_t>(1, jobs.size()));
  const std::size_t refused = count(State::refused), total = own.size() - refused;
  fmt::print("{}{} runs: {} done before, {} to do in {} processes{}{}\n",
             options.only ? fmt::format("part {} of {}: ", options.only->number, options.only->count) : "",
             own.size(), count(State::done), jobs.size(), processes,
             restarts > 0 ? fmt::format(", {} from the last checkpoint", restarts) : "",
             refused > 0 ? fmt::format(", {} refused", refused) : "");
  std::fflush(stdout);

  using Clock = std::chrono::steady_clock;
  std::vector<Clock::time_point> began(runs.size());
  std::size_t finished = total - jobs.size();
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
        if (options.only)
          write_note(k);
        else
          write_manifest(runs);
        const double seconds = std::chrono::duration<double>(Clock::now() - began[k]).count();
        const std::string what = !runs[k].status ? "FAILED: " + runs[k].reason
                                 : runs[k].status->nodes > 0
                                     ? fmt::format("done, {} nodes", runs[k].status->nodes)
                                     : "done"; // milling has none
        fmt::print("[{}/{}] {}: {}, {}\n", ++finished, total, study.runs[k].name, what,
                   results::duration_format(seconds));
        std::fflush(stdout);
      });

  if (!options.only) write_pages(runs, options.output, pages);
  for (const std::size_t k : own)
    if (runs[k].state == State::failed) tell_failure(study.runs[k], runs[k], options.output);
  if (!options.only) tell_pages(options.output, pages);
  if (!complete) {
    fmt::print(stderr, "interrupted: {} of {} runs ended; the same command goes on from here\n", finished,
               total);
    return Exit::interrupted;
  }
  if (count(State::failed) > 0) return Exit::diverged;
  return refused > 0 ? Exit::bad_input : Exit::done;
}

Exit merge_batch(const Study& study, std::vector<RunRecord> runs, const BatchOptions& options,
                 const Pages& pages) {
  check_folder(study, options.output, pages.kind, false);
  if (!fs::exists(options.output / manifest_file))
    throw InputError(
        fmt::format("the output folder {} holds no runs of a {}", options.output.string(), pages.kind));
  const results::FolderLock lock(options.output, pages.kind.c_str(), results::FolderLock::Use::shared);
  find_earlier(study, runs, options.output, pages.kind, true);
  std::size_t failed = 0, pending = 0;
  for (const RunRecord& run : runs) {
    failed += run.state == State::failed;
    pending += run.state == State::pending;
  }
  fmt::print("{} runs: {} done, {} failed, {} not done yet\n", runs.size(), runs.size() - failed - pending,
             failed, pending);
  write_pages(runs, options.output, pages);
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (runs[k].state == State::failed) tell_failure(study.runs[k], runs[k], options.output);
  tell_pages(options.output, pages);
  if (failed > 0) return Exit::diverged;
  return pending > 0 ? Exit::interrupted : Exit::done;
}

} // namespace cnem::study
