/// write FILE: the models of models.hpp as headers, one after the other, and a function that visits their chains.
#include <kte/robots/header.hpp>

#include <fstream>

#include "header/models.hpp"

int main(int, char** arguments) {
  std::ofstream out(arguments[1]);
  std::string visits;
  for (const auto& [name, model] : header_models::all()) {
    out << kte::to_header(model, name).substr(sizeof "#pragma once");
    visits += "  visit(\"" + name + "\", robots::" + kte::detail::robot_identifier(name) + ");\n";
  }
  out << "template <class Visit>\nvoid for_each_robot(const Visit& visit) {\n" << visits << "}\n";
}
