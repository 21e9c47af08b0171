/* Names of MercuryDPM that an adhesive force meets, with as little behind them as a test of it needs. */
#ifndef LIKE_MERCURY_LOGGER_H
#define LIKE_MERCURY_LOGGER_H
#include <stdexcept>
enum Level { ERROR };
inline void logger(Level, const char *text) { throw std::runtime_error(text); }
#endif
