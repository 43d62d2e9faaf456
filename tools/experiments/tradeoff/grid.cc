#include "experiments/tradeoff/grid.h"

#include <set>
#include <string>

#include "experiments/tradeoff/candidate.h"

namespace dpe::experiments::tradeoff {
namespace {

constexpr int kSteps[] = {1, 2, 4, 8, 16, 32};
constexpr IntegrationMethod kMethods[] = {
    IntegrationMethod::kExplicitEuler, IntegrationMethod::kSymplecticEuler,
    IntegrationMethod::kLinearlyImplicitEuler, IntegrationMethod::kImplicitEuler,
    IntegrationMethod::kTrBdf2};

// Those of one method and number of steps.
void AddSolvers(IntegrationMethod method, int steps,
                std::vector<StepSettings>* settings) {
  const auto add = [&](const char* solver, double tolerance, double newton) {
    settings->push_back({method, steps, solver, tolerance, newton});
  };
  add("cholesky", 1e-5, 1e-13);
  if (!UsesLinearSolver(method)) return;
  add("auto", 1e-5, 1e-13);
  for (double tolerance : {1e-2, 1e-5, 1e-8}) add("cg", tolerance, 1e-13);
  if (!UsesNewton(method)) return;
  for (double newton : {1e-6, 1e-4, 1e-2}) add("cholesky", 1e-5, newton);
  for (double newton : {1e-6, 1e-4}) add("cg", 1e-5, newton);
}

std::string Id(const std::string& kind, const Candidate& candidate) {
  std::string id = kind + "-" + candidate.scene + "-";
  for (char c : SettingsText(candidate.settings)) id += c == ' ' ? '-' : c;
  return id;
}

Job MakeJob(const std::string& kind, const std::string& id,
            const Candidate& candidate) {
  Job job;
  job.Set("id", id);
  job.Set("kind", kind);
  SetCandidate(candidate, &job);
  return job;
}

void AddReference(const std::string& scene, bool uniform, std::vector<Job>* jobs) {
  Candidate candidate;
  candidate.scene = scene;
  Job job = MakeJob("tradeoff_reference",
                    "reference-" + scene + (uniform ? "-uniform" : ""), candidate);
  job.Set("uniform", uniform);
  jobs->push_back(job);
}

void AddSimulations(const std::string& scene, std::vector<Job>* jobs) {
  for (const StepSettings& settings : SimulationGrid()) {
    Candidate candidate;
    candidate.scene = scene;
    candidate.settings = settings;
    Job job = MakeJob("tradeoff_simulation", Id("simulation", candidate), candidate);
    // One check for each map: the others solve the same equations less exactly.
    job.Set("difference", settings.solver == "cholesky" &&
                              settings.newton_tolerance == 1e-13 &&
                              settings.steps <= 16);
    jobs->push_back(job);
  }
  // A limit on Newton's iterations is no way to save time: it is where a step fails.
  for (int limit : {1, 2, 4}) {
    Candidate candidate;
    candidate.scene = scene;
    candidate.max_newton_iterations = limit;
    jobs->push_back(
        MakeJob("tradeoff_simulation",
                Id("simulation", candidate) + "-iterations-" + std::to_string(limit),
                candidate));
  }
}

// Fits of one scene: all like the centre but for what is set.
class FitJobs {
 public:
  FitJobs(std::string scene, std::vector<Job>* jobs)
      : scene_(std::move(scene)), jobs_(jobs) {}

  Candidate Centre() const {
    Candidate candidate;
    candidate.scene = scene_;
    candidate.settings.steps = 2;
    candidate.frames = scene_ == "flag" ? 21 : 51;
    return candidate;
  }

  // @param what  of the variation, in the job's id
  Job* Add(const Candidate& candidate, const std::string& what,
           const std::string& settings = "nR") {
    Job job = MakeJob("tradeoff_fit", Id("fit", candidate) + "-" + what, candidate);
    job.Set("settings", settings);
    job.Set("estimate", "");
    job.Set("fit_solver", "auto");
    job.Set("horizon", "auto");
    job.Set("init", "auto");
    job.Set("memory_limit_mib", -1);
    job.Set("uniform", false);
    jobs_->push_back(job);
    return &jobs_->back();
  }

  void AddIntegrators() {
    for (IntegrationMethod method : kMethods) {
      for (int steps : kSteps) {
        Candidate candidate = Centre();
        candidate.settings.method = method;
        candidate.settings.steps = steps;
        Add(candidate, "nR");
      }
    }
  }

  void AddParameterizations() {
    for (const IntegrationMethod method :
         {IntegrationMethod::kTrBdf2, IntegrationMethod::kImplicitEuler}) {
      Candidate candidate = Centre();
      candidate.settings.method = method;
      Add(candidate, "nG", "nG")->Set("uniform", true);
      Add(candidate, "Rn", "Rn");
      Add(candidate, "RR", "RR");
      Add(candidate, "nL", "nL")->Set("max_iterations", 10);
      Add(candidate, "nR-damping")->Set("estimate", "damping");
      Add(candidate, "nR-drag")->Set("estimate", "drag");
    }
  }

  void AddSolvers() {
    for (const char* horizon : {"full", "grow", "shooting"}) {
      // Windows of many frames take minutes.
      if (std::string(horizon) == "shooting" && Centre().frames > 21) continue;
      Job* job = Add(Centre(), std::string("uniform-lm-") + horizon);
      job->Set("init", "uniform");
      job->Set("fit_solver", "lm");
      job->Set("horizon", horizon);
    }
    for (const char* horizon : {"full", "grow"}) {
      Job* job = Add(Centre(), std::string("uniform-lbfgs-") + horizon);
      job->Set("init", "uniform");
      job->Set("fit_solver", "lbfgs");
      job->Set("horizon", horizon);
    }
    Add(Centre(), "lbfgs")->Set("fit_solver", "lbfgs");
    Add(Centre(), "memory-0")->Set("memory_limit_mib", 0);
    for (double tolerance : {1e-2, 1e-5, 1e-8}) {
      Candidate candidate = Centre();
      candidate.settings.solver = "cg";
      candidate.settings.tolerance = tolerance;
      Add(candidate, "nR");
    }
  }

  void AddLengths() {
    for (int frames : {11, 21, 51, 101}) {
      if (frames == Centre().frames) continue;
      Candidate candidate = Centre();
      candidate.frames = frames;
      Add(candidate, "frames-" + std::to_string(frames));
    }
  }

 private:
  std::string scene_;
  std::vector<Job>* jobs_;
};

}  // namespace

std::vector<StepSettings> SimulationGrid() {
  std::vector<StepSettings> settings;
  for (IntegrationMethod method : kMethods) {
    for (int steps : kSteps) AddSolvers(method, steps, &settings);
  }
  for (IntegrationMethod method :
       {IntegrationMethod::kImplicitEuler, IntegrationMethod::kTrBdf2}) {
    settings.push_back({method, 64, "cholesky", 1e-5, 1e-13});
  }
  return settings;
}

std::vector<Job> TradeoffJobs() {
  std::vector<Job> jobs;
  for (const char* scene : {"side", "corners", "flag"}) {
    for (bool uniform : {false, true}) AddReference(scene, uniform, &jobs);
  }
  for (const char* scene : {"side", "corners", "flag"}) {
    AddSimulations(scene, &jobs);
    FitJobs fits(scene, &jobs);
    fits.AddIntegrators();
    fits.AddParameterizations();
    fits.AddSolvers();
    fits.AddLengths();
  }
  return jobs;
}

}  // namespace dpe::experiments::tradeoff
