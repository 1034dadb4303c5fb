/* SPDX-License-Identifier: MIT
 *
 * editor_start - starts of the editor, each in a process of its own. Only tests/bench/editor*.c
 * include it.
 */
#ifndef BENCH_EDITOR_START_H
#define BENCH_EDITOR_START_H

#include <gtk/gtk.h>
#include <stdbool.h>

/** process_worked - us of the processor, of the whole process. */
gint64 process_worked(void);
/** median - ms, of so many us, which are in order afterwards. */
double median(gint64 *us, int count);

/** start_is_one - is this process one that starts() began? Then start() is all it does. */
bool start_is_one(void);
int start(int argc, char **argv);
/** starts - of @program itself with @sample; prints the medians. */
void starts(const char *program, const char *sample);

#endif
