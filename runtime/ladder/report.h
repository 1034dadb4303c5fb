/* SPDX-License-Identifier: MIT
 *
 * report - what all commands share: loading programs, messages, files.
 *
 * Results go to call->out (standard output), diagnostics to standard error,
 * one per line in the form of diag_print(). It never ends the program.
 */
#ifndef LADDER_REPORT_H
#define LADDER_REPORT_H

#include "ladder/command.h"

#include "engine/trial/plant.h"

/** report_open - sets call->out to standard output. */
void report_open(struct call *call);
/** report_flush - flushes standard output. Fails: false, after one message per call. */
bool report_flush(struct call *call);

/** report_usage - prints what is wrong with the command line. Returns STATUS_WRONG. */
enum status report_usage(const struct call *call, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** report_missing - the program of call->arg[0] has no @kind "@name". Returns STATUS_WRONG. */
enum status report_missing(const struct call *call, const char *kind, const char *name);
/** report_no_memory - prints LD001 for @path. Returns STATUS_WRONG. */
enum status report_no_memory(const char *path);
/** report_no_text - @path is a code image, and the command needs a rung file.
 * Returns STATUS_NO after the message. */
enum status report_no_text(const char *path);
/** report_classic - prints that the command needs a rung file, if @path is a project of
 * ClassicLadder. Returns whether it is one. */
bool report_classic(const char *path);
/** report_diags - prints a list, and how many diagnostics did not fit into it. */
void report_diags(const struct diag_list *diags);
/** report_diag - prints one diagnostic; its argument as printf. */
void report_diag(struct diag place, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/** report_list - an empty list, for report_end(). NULL after a message about @path: no
 * memory. */
struct diag_list *report_list(const char *path);
/** report_end - prints @diags and frees it. Returns whether it had no error. */
bool report_end(struct diag_list *diags);
/** report_json_diags - prints a list as a JSON array. */
void report_json_diags(const struct diag_list *diags, const struct sink *out);
/** report_json_field - `, "NAME": "TEXT"`, or null for NULL. */
void report_json_field(const char *name, const char *text, const struct sink *out);
/** report_nowhere - a sink that keeps nothing. */
struct sink report_nowhere(void);

/** program_new - ladder_new() that also reads projects of ClassicLadder.
 * @faithful: reproduces the faults of ClassicLadder. NULL: no memory. */
struct ladder *program_new(bool faithful);
/** program_period - time between scans in ns: @given, or if 0 that of the program. */
int64_t program_period(const struct ladder *ladder, int64_t given);
/** report_read_program - loads a program: a file, or a project of plain IEC text as
 * paths_project() takes it. Fails: false, as ladder_load(), or after a message on standard error. */
bool report_read_program(struct ladder *ladder, const char *path);
/**
 * report_load - reads a program and, if @build, checks and translates it
 *
 * Prints all diagnostics. Returns STATUS_WRONG if the file cannot be read at all,
 * STATUS_NO if it has errors.
 */
enum status report_load(struct ladder *ladder, const char *path, bool build);

/** diff_programs - prints the differences from @a to @b, with --json as JSON: of their texts,
 * or only whether they run the same, if one is a code image. STATUS_NO: they differ. */
enum status diff_programs(struct call *call, struct ladder *a, struct ladder *b);

/* A program ready to be scanned. */
struct machine {
	struct ladder *ladder;
	void *memory;
	struct resource resource;
	struct arena skip;        /* of resource.still                        */
	struct ladder *plant_ladder;
	struct plant plant;       /* memory NULL: none                        */
};
/* How machine_open() loads; two of them matter for projects of ClassicLadder only. */
enum {
	MACHINE_WATCHED = 1,  /* with the power of all cells while resource.watch */
	MACHINE_FAITHFUL = 2, /* with the faults of ClassicLadder             */
	MACHINE_AS_FILE = 4,  /* with a task, as `ladder import` writes it    */
	MACHINE_LISTED = 8,   /* with the results of lists, ladder_watch_lists() */
};
/** machine_open - loads and builds @path; @how: bits as above.
 * Owns: machine_close(), always.   Fails: a status after diagnostics. */
enum status machine_open(struct machine *machine, const char *path, int how);
/** machine_open_call - machine_open() of the first argument of @call, with its --plant. */
enum status machine_open_call(struct machine *machine, const struct call *call, int how);
/** machine_skip - from now on scans leave out what has not changed, unless @call has --full-scan. */
void machine_skip(struct machine *machine, const struct call *call);
/** machine_add_plant - loads the plant at @path (trial/plant.h).
 * Fails: a status after diagnostics, the last one LD016 at @place. */
enum status machine_add_plant(struct machine *machine, const char *path,
			      struct diag place);
/** machine_plant - NULL: it has none. */
struct plant *machine_plant(struct machine *machine);
/**
 * machine_play - runs a stimulus script on a watched machine and prints no trace
 * @script: names @text in messages
 *
 * Fails: a status after diagnostics; the state is STATE_FAULT if the program faulted.
 */
enum status machine_play(struct machine *machine, const char *script, const char *text,
			 size_t len);
void machine_close(struct machine *machine);

/**
 * report_period - a time option in ns, more than 0
 * @preset_ns: value if the option is not given
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
/** report_save - replaces a file. Fails: STATUS_WRONG after a message. */
enum status report_save(const char *path, const void *bytes, size_t len);
#endif
