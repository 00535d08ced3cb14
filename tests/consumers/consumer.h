// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Programs that load an exported world into a real engine and say what they find there, so that
// tests see it as a user's simulator does. `PROGRAM WORLD ORDERS` reads a file with an order a line
// and answers each with a line; it fails where the engine refuses the world. Orders:
//   count                           how many solids there are
//   names                           their names
//   gravity                         x y z
//   ray X Y Z  DX DY DZ             distance to the first of what is seen, or -1
//   probe X Y Z  DX DY DZ           distance to the first solid, or -1
//   sweep X Y Z  X Y Z  SX SY SZ YAW   a box from place to place: "free" or "blocked"
//   drop R  SECONDS  X Y Z          where a ball of this radius is after that time: x y z
#pragma once

#include <array>
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using Triple = std::array<double, 3>;

struct Consumer {
  virtual ~Consumer() = default;
  virtual std::vector<std::string> names() { throw std::runtime_error("no names here"); }
  virtual Triple gravity() { throw std::runtime_error("no gravity here"); }
  enum class Meets { seen, solids };
  virtual double ray(const Triple&, const Triple&, Meets) {
    throw std::runtime_error("no rays here");
  }
  virtual bool is_free(const Triple&, const Triple&, const Triple&, double) {
    throw std::runtime_error("no sweeps here");
  }
  // Where balls are after a time. All fall together.
  virtual std::vector<Triple> drop(double, double, const std::vector<Triple>&) {
    throw std::runtime_error("no balls here");
  }
};

inline std::istream& operator>>(std::istream& in, Triple& t) { return in >> t[0] >> t[1] >> t[2]; }
inline std::ostream& operator<<(std::ostream& out, const Triple& t) {
  return out << t[0] << ' ' << t[1] << ' ' << t[2];
}

inline void answer(Consumer& consumer, const std::string& line) {
  std::istringstream in(line);
  std::string order;
  in >> order;
  Triple a, b, size;
  double radius, seconds, yaw;
  if (order == "count") {
    std::cout << consumer.names().size();
  } else if (order == "names") {
    for (const std::string& name : consumer.names()) std::cout << name << ' ';
  } else if (order == "gravity") {
    std::cout << consumer.gravity();
  } else if (order == "ray" && in >> a >> b) {
    std::cout << consumer.ray(a, b, Consumer::Meets::seen);
  } else if (order == "probe" && in >> a >> b) {
    std::cout << consumer.ray(a, b, Consumer::Meets::solids);
  } else if (order == "sweep" && in >> a >> b >> size >> yaw) {
    std::cout << (consumer.is_free(a, b, size, yaw) ? "free" : "blocked");
  } else if (order == "drop" && in >> radius >> seconds) {
    std::vector<Triple> balls;
    while (in >> a) balls.push_back(a);
    for (const Triple& end : consumer.drop(radius, seconds, balls)) std::cout << end << "  ";
  } else {
    throw std::runtime_error("what is '" + line + "'?");
  }
  std::cout << '\n';
}

// The whole program but for loading the world.
template <typename Load>
int serve(int argc, char** argv, Load load) try {
  if (argc != 3) throw std::runtime_error("usage: PROGRAM WORLD ORDERS");
  auto consumer = load(std::string(argv[1]));
  std::ifstream orders(argv[2]);
  std::cout.precision(9);
  for (std::string line; std::getline(orders, line);) answer(*consumer, line);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
