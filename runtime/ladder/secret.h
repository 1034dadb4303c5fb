/* SPDX-License-Identifier: MIT
 *
 * secret - a password that a person types, or that a program hands over by a file descriptor. It is
 * never an argument and never shown.
 */
#ifndef LADDER_SECRET_H
#define LADDER_SECRET_H

#include "ladder/report.h"

#define SECRET_MOST 129

/**
 * secret_read - the next line of --password-fd N; else typed at the terminal, without echo
 * @question: "Program password"
 * @out: SECRET_MOST bytes; secret_wipe() it
 *
 * Scan-safe: no. Fails: a status after a message.
 */
enum status secret_read(const struct call *call, const char *question, char *out);
/** secret_wipe - also if the compiler sees that nobody reads it again. */
void secret_wipe(void *bytes, size_t len);
#endif
