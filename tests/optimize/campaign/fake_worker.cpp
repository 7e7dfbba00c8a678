// What is here: a worker program for tests: answers by formula and misbehaves on purpose for certain replicates.
// What is not: tests. Arguments: "numbers" (plateau = 1000 x replicate) or "formula" (fake_evaluation), and a folder
// for its marks.
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

#include "optimize/campaign/worker_record.h"
#include "tests/optimize/search/study_support.h"

namespace {

using namespace perfora::optimize;

/// True at the first call for `name` in the folder, whichever process makes it.
bool first_time(const std::string& folder, const std::string& name) {
  const std::string path = folder + "/" + name;
  if (std::ifstream(path)) return false;
  std::ofstream(path) << "x";
  return true;
}

void misbehave(int replicate, const std::string& folder) {
  switch (replicate) {
    case 103:
      std::_Exit(42);
    case 104:
      if (first_time(folder, "crashed")) std::_Exit(3);
      break;
    case 105:
      std::cout << "this is not JSON" << std::endl;
      std::cout << "nor this" << std::endl;
      std::_Exit(0);
    case 106:
      std::raise(SIGKILL);
      break;
    case 107:
      ::sleep(1000);
      break;
    case 108:
      std::cout << "{\"status\": \"completed\"}" << std::endl;
      break;
    case 109:
      std::signal(SIGSEGV, SIG_DFL);  // a sanitizer would turn the crash into an exit code
      std::raise(SIGSEGV);
      break;
    case 110:
      ::usleep(300000);
      break;
    case 112:
      std::raise(SIGSTOP);
      break;
    case 113:
      for (int k = 0; k < 3; ++k) {
        std::cout << "{\"alive\":true}" << std::endl;
        ::usleep(20000);
      }
      break;
    case 115:
      std::cout << sign_of_life({}) << std::endl;
      for (int k = 0; k < 20; ++k) {
        std::cout << sign_of_life({0.4, "strain 4 %", 0.04, 1e5}) << std::endl;
        ::usleep(20000);
      }
      break;
    default:
      break;
  }
}

}  // namespace

int main(int, char** arguments) {
  const std::string mode = arguments[1], folder = arguments[2];
  for (std::string line; std::getline(std::cin, line);) {
    const Request request = request_from_json(nlohmann::json::parse(line));
    std::ofstream(folder + "/pids", std::ios::app) << ::getpid() << "\n";
    misbehave(request.replicate, folder);
    if (request.replicate == 114) {
      std::cout << "{\"trouble\": \"no space left\"}" << std::endl;
      continue;
    }
    Evaluation evaluation = mode == "formula" ? fake_evaluation(request) : failed_evaluation("", request.replicate);
    if (mode == "numbers") {
      evaluation.status = perfora::results::RunStatus::completed;
      evaluation.summary.plateau_stress = 1000.0 * request.replicate;
    }
    if (request.replicate == 111) evaluation.status = perfora::results::RunStatus::stopped;
    std::cout << to_json(evaluation, true).dump() << std::endl;
  }
}
