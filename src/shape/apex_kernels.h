// SPDX-License-Identifier: MIT
#pragma once

// Included by sources compiled for one instruction set: plain data only.

namespace tunica {

/// A Table, as it lies in memory: `columns` cubics of four coefficients for each step, steps even within each span.
struct TableView {
  static constexpr int most_spans = 40;
  const double* cubics;
  int columns, spans;
  double first, last;
  double from[most_spans], per_x[most_spans], first_step[most_spans], last_step[most_spans];
};

/// What ApexTables holds, for points (x, y, z) of which many are asked for at once.
struct ApexView {
  TableView track;   ///< x and y by arc length
  TableView place;   ///< x, a and time (times speed) by level
  TableView course;  ///< x and y by time
  double size, speed, rise, sharpest, on_profile;
};

/// What is within a distance of a place: 1 / distance^2.
struct Disc {
  double x, y, z, per_square;
};

/// Where the tables do not serve, the answer is no number (NaN), and the longer way is to be taken. All sets give the
/// same bits. @param count  of points, any
struct ApexKernels {
  /// ApexTables::moved of points in space: each is replaced by where it is after dt. @param points  x, y, z of each
  void (*move)(const ApexView&, double dt, double* points, long count);
  /// ApexTables::facing: each is replaced by a normal of any length.
  void (*face)(const ApexView&, double* points, long count);
  /// Where on the apex points are: the nearest arc length; the angle around the axis, in degrees.
  void (*locate)(const ApexView&, const double* x, const double* y, const double* z, long count, double* theta,
                 double* a);
  /// Whether they are farther than an arc length: 1 or 0, where ApexTables::guess() tells.
  void (*beyond)(const ApexView&, const double* x, const double* y, const double* z, long count, double a,
                 double* answer);
  /// The disc in which each point is most deeply, from 1 (0: in none), and how deeply: 1 - distance / radius.
  void (*deepest)(const Disc*, int discs, const double* x, const double* y, const double* z, long count, double* disc,
                  double* depth);
};

/// Those for this machine.
const ApexKernels& apex_kernels();

namespace sse2 {
const ApexKernels& apex_kernels();
}
namespace avx2 {
const ApexKernels& apex_kernels();
}

}  // namespace tunica
