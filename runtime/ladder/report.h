/* SPDX-License-Identifier: MIT
 *
 * report - what all commands share: loading a program and telling what is
 * wrong.
 *
 * Results go to call->out (standard output), diagnostics to standard error,
 * one a line in the form of diag_print. It never ends the program.
 */
#ifndef LADDER_REPORT_H
#define LADDER_REPORT_H

#include "ladder/command.h"

#include "engine/trial/plant.h"

/** report_open - results of @call go to standard output from here on. */
void report_open(struct call *call);
/** report_flush - false, after one message, when they could not be written. */
bool report_flush(struct call *call);

/** report_usage - a wrong command line. Returns STATUS_WRONG. */
enum status report_usage(const struct call *call, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** report_no_memory - says so of @path. Returns STATUS_WRONG. */
enum status report_no_memory(const char *path);
/** report_diags - all of a list, and how many did not fit into it. */
void report_diags(const struct diag_list *diags);
/** report_diag - one that no list holds; its argument as printf. */
void report_diag(struct diag place, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** report_json_diags - a list as a JSON array. */
void report_json_diags(const struct diag_list *diags, const struct sink *out);

/** program_new - what takes every file that a command takes: ladder_new, and projects of
 * ClassicLadder. @faithful: with the faults of these. NULL: no memory. */
struct ladder *program_new(bool faithful);
/** program_period - from scan to scan: @given, or as the program wants it; ns. */
int64_t program_period(const struct ladder *ladder, int64_t given);
/**
 * report_load - reads a program and, if @build, checks and translates it
 *
 * Prints what it finds. STATUS_WRONG: cannot be read at all; STATUS_NO: errors.
 */
enum status report_load(struct ladder *ladder, const char *path, bool build);

/* A program ready to be scanned. */
struct machine {
	struct ladder *ladder;
	void *memory;
	struct resource resource;
	struct ladder *plant_ladder;
	struct plant plant;       /* memory NULL: none                        */
};
/** machine_open - loads and builds @path. Owns: machine_close(), always. */
enum status machine_open(struct machine *machine, const char *path);
/** report_classic - is @path a project of ClassicLadder? Then it is told that this command
 * wants a rung file. */
bool report_classic(const char *path);
/** machine_open_file - an imported project as `ladder import` would write it: with its
 * period. */
enum status machine_open_file(struct machine *machine, const char *path);
/** machine_open_faithful - an imported project with the faults of its original. */
enum status machine_open_faithful(struct machine *machine, const char *path);
/** machine_watch - the same, with the power of all cells while resource.watch. */
enum status machine_watch(struct machine *machine, const char *path);
/** machine_add_plant - the program at @path beside it, as trial/plant.h has it.
 * Fails: a status after diagnostics, of which the last one is LD016 at @place. */
enum status machine_add_plant(struct machine *machine, const char *path,
			      struct diag place);
/** machine_plant - NULL: it has none. */
struct plant *machine_plant(struct machine *machine);
void machine_close(struct machine *machine);

/**
 * report_period - a time option in ns, more than 0; @preset_ns if it is not given
 * @preset_ns: when it is not given
 * Fails: false after a message about wrong usage.
 */
bool report_period(const struct call *call, const char *option,
		   int64_t preset_ns, int64_t *ns);
/** report_count - a whole number from 1 to @most. As report_period. */
bool report_count(const struct call *call, const char *option, int64_t preset,
		  int64_t most, int64_t *count);
/** report_read - the text of a file, or of standard input for `-`.
 * Owns: the caller, free(). NULL after a message. */
char *report_read(const char *path, size_t *len);
/** report_save - writes a file; else STATUS_WRONG after a message. */
enum status report_save(const char *path, const void *bytes, size_t len);
#endif
