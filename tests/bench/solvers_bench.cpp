// SPDX-License-Identifier: MIT
// Speed against accuracy on the activator-inhibitor problem (thesis 9.12, 9.13): methods of a model in Lua beside CVODE
// with KLU driven by hand in C++ with the analytic Jacobian; every time with its error, in one run, single thread.
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

namespace {

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The problem as one would write it in C++; unknowns a0, h0, a1, h1, ... on a square of cells.
struct Problem {
  int side;
  double Dh;
  std::vector<int> begin{0}, to;
  std::vector<double> start;

  Problem(int n, double diffusion) : side(n), Dh(diffusion) {
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        if (r > 0) to.push_back((r - 1) * n + c);
        if (c > 0) to.push_back(r * n + c - 1);
        if (c + 1 < n) to.push_back(r * n + c + 1);
        if (r + 1 < n) to.push_back((r + 1) * n + c);
        begin.push_back(static_cast<int>(to.size()));
      }
    uint64_t state = 1;
    const auto draw = [&] {
      uint64_t z = (state += 0x9e3779b97f4a7c15ull);
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
      return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
    };
    for (int i = 0; i < n * n; ++i) {
      start.push_back(1.503012 * (1 + .01 * (2 * draw() - 1)));
      start.push_back(7.075367 * (1 + .01 * (2 * draw() - 1)));
    }
  }
  int cells() const { return side * side; }
};

int rates(double, N_Vector y_, N_Vector f_, void* data) {
  const Problem& p = *static_cast<Problem*>(data);
  const double* y = N_VGetArrayPointer(y_);
  double* f = N_VGetArrayPointer(f_);
  for (int i = 0; i < p.cells(); ++i) {
    const double a = y[2 * i], h = y[2 * i + 1];
    double spread_a = 0, spread_h = 0;
    for (int k = p.begin[i]; k < p.begin[i + 1]; ++k) {
      spread_a += y[2 * p.to[k]] - a;
      spread_h += y[2 * p.to[k] + 1] - h;
    }
    f[2 * i] = a * a / (1 + h) + .02 - .2 * a + .2 * spread_a;
    f[2 * i + 1] = a * a - .32 * h + p.Dh * spread_h;
  }
  return 0;
}

int jacobian(double, N_Vector y_, N_Vector, SUNMatrix m, void* data, N_Vector, N_Vector, N_Vector) {
  const Problem& p = *static_cast<Problem*>(data);
  const double* y = N_VGetArrayPointer(y_);
  sunindextype* begin = SUNSparseMatrix_IndexPointers(m);
  sunindextype* column = SUNSparseMatrix_IndexValues(m);
  double* value = SUNSparseMatrix_Data(m);
  sunindextype n = 0;
  const auto put = [&](int c, double v) { column[n] = c, value[n++] = v; };
  for (int i = 0; i < p.cells(); ++i) {
    const double a = y[2 * i], h = y[2 * i + 1];
    const int degree = p.begin[i + 1] - p.begin[i];
    for (const int row : {0, 1}) {
      begin[2 * i + row] = n;
      const double D = row == 0 ? .2 : p.Dh;
      bool own = false;
      const auto put_own = [&] {
        own = true;
        put(2 * i, row == 0 ? 2 * a / (1 + h) - .2 - degree * D : 2 * a);
        put(2 * i + 1, row == 0 ? -a * a / ((1 + h) * (1 + h)) : -.32 - degree * D);
      };
      for (int k = p.begin[i]; k < p.begin[i + 1]; ++k) {
        if (p.to[k] > i && !own) put_own();
        put(2 * p.to[k] + row, D);
      }
      if (!own) put_own();
    }
  }
  begin[2 * p.cells()] = n;
  return 0;
}

struct Outcome {
  double seconds;
  std::vector<double> y;
};

Outcome cvode_by_hand(Problem& p, double until, double tolerance) {
  SUNContext context;
  SUNContext_Create(nullptr, &context);
  const int n = 2 * p.cells();
  Outcome best{1e300, {}};
  for (int repeat = 0; repeat < 3; ++repeat) {
    const double begun = cpu_seconds();
    N_Vector y = N_VNew_Serial(n, context);
    std::copy(p.start.begin(), p.start.end(), N_VGetArrayPointer(y));
    void* cvode = CVodeCreate(CV_BDF, context);
    CVodeInit(cvode, rates, 0, y);
    CVodeSetUserData(cvode, &p);
    CVodeSStolerances(cvode, tolerance, tolerance);
    CVodeSetMaxNumSteps(cvode, 1000000);
    SUNMatrix m = SUNSparseMatrix(n, n, 8 * n, CSR_MAT, context);
    SUNLinearSolver solver = SUNLinSol_KLU(y, m, context);
    SUNLinSol_KLUSetOrdering(solver, 0);
    CVodeSetLinearSolver(cvode, solver, m);
    CVodeSetJacFn(cvode, jacobian);
    double t = 0;
    CVode(cvode, until, y, &t, CV_NORMAL);
    best.seconds = std::min(best.seconds, cpu_seconds() - begun);
    best.y.assign(N_VGetArrayPointer(y), N_VGetArrayPointer(y) + n);
    SUNLinSolFree(solver);
    SUNMatDestroy(m);
    CVodeFree(&cvode);
    N_VDestroy(y);
    if (best.seconds > 1) break;
  }
  SUNContext_Free(&context);
  return best;
}

double error(const std::vector<double>& y, const std::vector<double>& reference) {
  double worst = 0;
  for (const size_t column : {0, 1}) {
    double difference = 0, size = 0;
    for (size_t i = column; i < y.size(); i += 2) {
      difference += (y[i] - reference[i]) * (y[i] - reference[i]);
      size += reference[i] * reference[i];
    }
    worst = std::max(worst, std::sqrt(difference / size));
  }
  return worst;
}

struct Row {
  std::string method, dt, tolerance;
  double seconds;
  long steps, evaluations;
  std::vector<double> y;
};

/// The model in Lua, under the program beside this one.
std::vector<Row> in_lua(const std::string& program, const std::string& script, const Problem& p, double until,
                        const std::string& runs) {
  char folder[] = "/tmp/solvers_bench_XXXXXX";
  if (!mkdtemp(folder)) throw std::runtime_error("no temporary folder");
  const std::string out = std::string(folder) + "/state";
  const std::string command = fmt::format("SIDE={} DH={} UNTIL={} OUT={} RUNS='{}' '{}' -q '{}' 2>/dev/null", p.side,
                                          p.Dh, until, out, runs, program, script);
  FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  char buffer[4096];
  for (size_t n; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
  if (pclose(pipe) != 0) throw std::runtime_error("the model in Lua failed: " + command);
  std::vector<Row> rows;
  std::istringstream lines(text);
  for (Row row; lines >> row.method >> row.dt >> row.tolerance >> row.seconds >> row.steps >> row.evaluations;) {
    const std::string path = out + std::to_string(rows.size() + 1);
    std::ifstream file(path);
    row.y.clear();
    for (double value; file >> value;) row.y.push_back(value);
    unlink(path.c_str());
    rows.push_back(row);
  }
  rmdir(folder);
  return rows;
}

void compare(const std::string& program, const std::string& script, const char* name, int side, double Dh, double until,
             const std::string& runs, const std::vector<double>& tolerances) {
  Problem p(side, Dh);
  const std::string tight = "dp54 0 1e-10;";
  std::vector<Row> rows = in_lua(program, script, p, until, tight + runs);
  const std::vector<double> reference = rows[0].y;
  fmt::print("\n{}: {} x {} cells, until {}\n{:32} {:>10} {:>10} {:>9} {:>9}\n", name, side, side, until, "method",
             "error", "seconds", "steps", "rates");
  double euler = 0, own = 1e300, hand = 1e300, quickest = 1e300;
  std::string best;
  for (size_t k = 1; k < rows.size(); ++k) {
    const Row& r = rows[k];
    const double e = error(r.y, reference);
    const std::string label = r.method + (r.dt != "0" ? " dt " + r.dt : " tolerance " + r.tolerance);
    fmt::print("{:32} {:>10.2e} {:>10.4f} {:>9} {:>9}\n", label, e, r.seconds, r.steps, r.evaluations);
    // Of order 1: error times time is constant; but no step may be longer than is stable.
    if (r.method == "euler") euler = r.seconds * std::max(std::stod(r.dt) * (8 * Dh + .32) / 2, e / 1e-3);
    if (r.method != "euler" && e <= 1e-3 && r.seconds < own) own = r.seconds, best = label;
  }
  for (const double tolerance : tolerances) {
    const Outcome o = cvode_by_hand(p, until, tolerance);
    const double e = error(o.y, reference);
    fmt::print("{:32} {:>10.2e} {:>10.4f}\n", fmt::format("CVODE, KLU by hand, {:.0e}", tolerance), e, o.seconds);
    if (e <= 1e-3) hand = std::min(hand, o.seconds);
    quickest = std::min(quickest, o.seconds);
  }
  if (hand == 1e300) hand = quickest;  // it took that long to be less exact
  fmt::print(
      "for an error of 1e-3: {} is {:.1f} times faster than forward Euler, {:.1f} times faster than CVODE by hand\n",
      best, euler / own, hand / own);
}

}  // namespace

int main(int, char** argv) {
  const std::string folder = std::string(argv[0]).substr(0, std::string(argv[0]).rfind('/'));
  const std::string program = folder + "/../tunica", script = TUNICA_BENCH_FOLDER "/solvers.lua";
  const std::string explicit_ones =
      "rkc2 0 1e-5;rkc2 0 3e-6;rkc2 0 1e-6;rkc2 0 1e-7;rkc2 0 3e-8;rkc2 0.1 0;rkc2 1 0;rkc2 1.2 0;heun {0} 0;bs32 0 "
      "1e-4;auto 0 1e-6;auto 0 1e-7;";
  const std::string implicit = "crank_nicolson 0.5 0;crank_nicolson 0.1 0;bdf 0 1e-5;bdf 0 1e-6;";
  fmt::print(
      "Speed against accuracy, seconds of thread CPU, rules in Lua; error: largest over a, h of |y - ref| / |ref|.\n");
  compare(program, script, "mild", 50, 4, 150,
          "euler 0.025 0;" + fmt::format(fmt::runtime(explicit_ones), 0.05) + implicit, {1e-4, 1e-5, 1e-6});
  compare(program, script, "stiff", 50, 100, 45,
          "euler 0.0006 0;" + fmt::format(fmt::runtime(explicit_ones), 0.002) + implicit, {1e-5, 1e-6, 1e-7});
  compare(program, script, "mild, large", 200, 4, 150, "euler 0.025 0;rkc2 0 3e-6;rkc2 0 1e-6;rkc2 1 0;rkc2 1.2 0;auto 0 1e-6;",
          {1e-5});
  compare(program, script, "stiff, large", 200, 100, 45,
          "euler 0.0024 0;rkc2 0 1e-7;rkc2 0 3e-8;rkc2 0.1 0;auto 0 3e-8;", {1e-5});
}
