#pragma once
#include <locale.h>

namespace wormdrive {

/// While it lives the calling thread has the locale "C": for libraries that read numbers as the locale spells them.
class ClassicLocale {
 public:
  ClassicLocale() : classic_(newlocale(LC_ALL_MASK, "C", nullptr)), before_(uselocale(classic_)) {}
  ~ClassicLocale() {
    uselocale(before_);
    freelocale(classic_);
  }
  ClassicLocale(const ClassicLocale&) = delete;
  ClassicLocale& operator=(const ClassicLocale&) = delete;

 private:
  locale_t classic_, before_;
};

}  // namespace wormdrive
