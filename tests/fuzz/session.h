/// One session that targets share: the backend `cpu`, on one thread.
#pragma once

#include "target.h"
#include "vorpipe.h"

namespace vorpipe::fuzz {

inline Session& session() {
  static Session opened = [] {
    BackendOptions options;
    options.name = "cpu";
    options.threads = 1;
    auto session = Session::open(options);
    require(session.has_value(), "the backend cpu is always there");
    return std::move(*session);
  }();
  return opened;
}

}  // namespace vorpipe::fuzz
