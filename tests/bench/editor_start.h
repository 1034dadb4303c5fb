/* SPDX-License-Identifier: MIT
 *
 * editor_start - starts the editor, each time in a process of its own. Only
 * tests/bench/editor*.c include it.
 */
#ifndef BENCH_EDITOR_START_H
#define BENCH_EDITOR_START_H

#include <gtk/gtk.h>
#include <stdbool.h>

/** process_worked - processor time of the whole process in us. */
gint64 process_worked(void);
/** median - in ms, of @count us; sorts them. */
double median(gint64 *us, int count);

/** start_is_one - whether starts() began this process; then it only calls start(). */
bool start_is_one(void);
int start(int argc, char **argv);
/** starts - starts @program with @sample several times and prints the medians. */
void starts(const char *program, const char *sample);

#endif
