// A 6 x 6 matrix of a body's three linear and three angular axes: its masses, and what holds it back.
#pragma once
#include <array>
#include <cmath>
#include <glm/glm.hpp>

namespace seascape {

// Linear part first: velocities (m/s, rad/s), momenta or forces (N, N m).
struct Vector6 {
  glm::dvec3 linear{0.0}, angular{0.0};
  Vector6 operator+(const Vector6& b) const { return {linear + b.linear, angular + b.angular}; }
  Vector6 operator-(const Vector6& b) const { return {linear - b.linear, angular - b.angular}; }
  Vector6 operator*(double f) const { return {linear * f, angular * f}; }
  double operator[](int i) const { return i < 3 ? linear[i] : angular[i - 3]; }
  double& operator[](int i) { return i < 3 ? linear[i] : angular[i - 3]; }
};
inline double dot(const Vector6& a, const Vector6& b) {
  return glm::dot(a.linear, b.linear) + glm::dot(a.angular, b.angular);
}

struct Matrix6 {
  std::array<std::array<double, 6>, 6> rows{};

  static Matrix6 diagonal(const std::array<double, 6>& values) {
    Matrix6 m;
    for (std::size_t i = 0; i < 6; ++i) m.rows[i][i] = values[i];
    return m;
  }
  Matrix6 operator+(const Matrix6& b) const {
    Matrix6 m = *this;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) m.rows[i][j] += b.rows[i][j];
    return m;
  }
  Matrix6 operator*(double f) const {
    Matrix6 m = *this;
    for (auto& row : m.rows)
      for (double& value : row) value *= f;
    return m;
  }
  Vector6 operator*(const Vector6& v) const {
    const auto row = [&](std::size_t i) {
      return rows[i][0] * v.linear.x + rows[i][1] * v.linear.y + rows[i][2] * v.linear.z + rows[i][3] * v.angular.x +
             rows[i][4] * v.angular.y + rows[i][5] * v.angular.z;
    };
    return {{row(0), row(1), row(2)}, {row(3), row(4), row(5)}};
  }
  // Adds what a 3 x 3 matrix at a point r from the centre does to the body: J^T k J with J = (1, -[r]).
  void add_at(const glm::dvec3& r, const glm::dmat3& k) {
    const glm::dmat3 cross(0.0, r.z, -r.y, -r.z, 0.0, r.x, r.y, -r.x, 0.0);  // [r], columns
    const glm::dmat3 kr = k * cross, rk = cross * k, rkr = cross * kr;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        rows[std::size_t(i)][std::size_t(j)] += k[j][i];
        rows[std::size_t(i)][std::size_t(j + 3)] -= kr[j][i];
        rows[std::size_t(i + 3)][std::size_t(j)] += rk[j][i];
        rows[std::size_t(i + 3)][std::size_t(j + 3)] -= rkr[j][i];
      }
  }
  // The same of k n n^T, along a unit vector n alone.
  void add_along(const glm::dvec3& r, const glm::dvec3& n, double k) {
    const glm::dvec3 t = glm::cross(r, n);
    const std::array<double, 6> w{n.x, n.y, n.z, t.x, t.y, t.z};
    for (std::size_t i = 0; i < 6; ++i) {
      const double part = k * w[i];
      for (std::size_t j = 0; j < 6; ++j) rows[i][j] += part * w[j];
    }
  }
};

// The lower factor L of a symmetric matrix L L^T (Cholesky); `positive` is false where the matrix is not positive
// definite, and then it solves nothing.
class Cholesky6 {
 public:
  explicit Cholesky6(const Matrix6& m) {
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = m.rows[i][j];
        for (std::size_t k = 0; k < j; ++k) sum -= l_[i][k] * l_[j][k];
        if (i == j) {
          positive = positive && sum > 0.0;
          per_diagonal_[i] = 1.0 / std::sqrt(sum > 0.0 ? sum : 1.0);
        } else {
          l_[i][j] = sum * per_diagonal_[j];
        }
      }
  }
  Vector6 solve(const Vector6& b) const {
    double x[6] = {b.linear.x, b.linear.y, b.linear.z, b.angular.x, b.angular.y, b.angular.z};
    for (std::size_t i = 0; i < 6; ++i) {
      double sum = x[i];
      for (std::size_t k = 0; k < i; ++k) sum -= l_[i][k] * x[k];
      x[i] = sum * per_diagonal_[i];
    }
    for (std::size_t i = 6; i-- > 0;) {
      double sum = x[i];
      for (std::size_t k = i + 1; k < 6; ++k) sum -= l_[k][i] * x[k];
      x[i] = sum * per_diagonal_[i];
    }
    return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  }
  bool positive = true;

 private:
  std::array<std::array<double, 6>, 6> l_{};  // below the diagonal
  std::array<double, 6> per_diagonal_{};
};

}  // namespace seascape
