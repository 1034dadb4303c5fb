/* SPDX-License-Identifier: MIT
 *
 * scenario - tests of a program in virtual time.
 *
 *   scenario "stop wins over start"        # any number in a file
 *     period 10ms                          # if not said: of the tasks, or 10ms
 *     speed 500                            # words of instructions a millisecond
 *     plant "door.plant.rung"              # before the first scenario: of all
 *     at 0ms     Open = 1, Stop = 0        # before the first scan at t >= 0
 *     at 20ms    expect Motor = 1          # checked after that scan
 *     at 1s      Stop = 1
 *     within 10ms expect Motor = 0         # in a scan of [1s, 1s + 10ms]
 *     for 2s     expect Motor = 0          # in every scan of [1s, 1s + 2s)
 *     always     not (Up and Down)         # after every scan of the scenario
 *     never      Heater and not Fan
 *
 * One statement a line, with any indentation; words in any case; comments behind `#` or
 * `//` or in (* *). Lines without `at` belong to the `at` before them, those before the
 * first one to 0; times must not go back. The first scan is at t = period; a scenario
 * ends when all expectations are decided.
 */
#ifndef TRIAL_SCENARIO_H
#define TRIAL_SCENARIO_H

#include "engine/base/sink.h"
#include "engine/scan/resource.h"
#include "engine/trial/formula.h"
#include "engine/trial/plant.h"
#include "engine/trial/twin.h"

#define SCENARIO_SCANS_MAX 100000000 /* of one scenario, so that it ends      */
#define SCENARIO_HISTORY 8           /* scans shown behind a failure          */

enum scenario_verb {
	VERB_SET, VERB_EXPECT, VERB_WITHIN, VERB_FOR, VERB_ALWAYS, VERB_NEVER,
};

/* Why an expectation failed. */
enum scenario_failure {
	FAILURE_FALSE, FAILURE_UNKNOWN, FAILURE_RANGE, FAILURE_PROGRAM, FAILURE_PLANT,
	FAILURE_COUNT
};
/** scenario_failure_text - "not true", "the program stopped with a fault". Static. */
const char *scenario_failure_text(enum scenario_failure failure);

struct scenario_step {
	enum scenario_verb verb;
	int line;
	int64_t at_ns, span_ns;
	struct location target;  /* of VERB_SET                               */
	struct formula *formula;
	const char *text;        /* as written, borrowed from the source      */
	int text_len;
	bool open;               /* while it runs: not decided yet            */
	bool plant;              /* of VERB_SET: of the plant                 */
};

struct scenario_watch {
	const char *name;
	struct location at;
	bool plant;              /* of the plant                              */
	union iec_value past[SCENARIO_HISTORY]; /* STRINGs: its own copies    */
};

struct scenario {
	const char *name;        /* in the arena, without its quotes          */
	int line;
	int64_t period_ns;       /* 0: not given yet                          */
	uint64_t speed;          /* of the board, words a millisecond; 0: scans take no time */
	bool with_plant;         /* it runs with the plant of its file        */
	struct scenario_step *step;
	int step_count;
	struct scenario_watch *watch; /* variables in expectations */
	int watch_count;
	int failed_line;         /* of the last run: the step that failed first; 0: passed */
	uint64_t failed_scan;    /* time of the failure                       */
	int64_t failed_ns;
	enum scenario_failure failure; /* reason of the failure               */
	const struct scenario_step *failed_step; /* value that failed; NULL: a fault */
};

struct scenario_file {
	const char *file;
	const struct image *plant; /* borrowed; or NULL                       */
	struct scenario *scenario;
	int count;
	const bool *stop;        /* set by the caller after reading, or NULL: when it is
				  * true, a run ends and fails */
};

/**
 * scenario_find_plant - the plant that a scenario file names, before scenario_read()
 * @out: gets the name as it is written, the path of a rung file from the scenario
 *       file's folder   @place: of it, for diagnostics
 *
 * Owns: @arena. Scan-safe: no. Fails: NULL: it names none (or there is no memory).
 */
const char *scenario_find_plant(const char *file, const char *text, size_t len,
				struct arena *arena, struct diag *place);
/** scenario_plant_token - the quoted name in the text; false: none.
 * scenario_is_plant - whether the statement at @lex names a plant. Scan-safe: no. */
bool scenario_plant_token(const char *text, size_t len, struct token *out);
bool scenario_is_plant(const struct lex *lex);
/**
 * scenario_read - reads a scenario file for a program
 * @file:  names it in diagnostics and reports; outlives @out
 * @text:  borrowed as long as @out
 * @image: of the program, which gives names their places
 * @plant: of its plant, whose variables are `plant.Level`; borrowed as long as @out.
 *         NULL: none; a scenario that names a plant is an error then
 * @projects: of the program and its plant; borrowed
 *
 * Owns: @arena.   Scan-safe: no.
 * Fails: false and a diagnostic for each error.
 */
bool scenario_read(const char *file, const char *text, size_t len,
		   const struct image *image, const struct image *plant,
		   struct formula_projects projects, struct arena *arena, struct scenario_file *out,
		   struct diag_list *diags);

/**
 * scenario_run - runs one scenario from a cold start
 * @resource: of the same program; it is started here
 * @plant: the one whose image was used for reading, or NULL; started if the scenario
 *         has one
 * @out: gets a report of failures, each line begins with `# `
 *
 * Returns whether everything passed. Scan-safe: no.
 */
bool scenario_run(const struct scenario_file *file, int index,
		  struct resource *resource, struct plant *plant,
		  const struct sink *out);

/**
 * scenario_each_act - the acts of a scenario, up to a scan
 * @file:  read with the images of @twin
 * @twin:  of the same program, with the plant if the scenario has one; initialised,
 *         nothing else; it runs here
 * @scans: how many
 * @take: gets each act, with the number of the scan before it; its pointers are valid
 *        until it returns
 *
 * Scan-safe: no. Fails: false: the twin cannot run that far.
 */
bool scenario_each_act(const struct scenario_file *file, int index, struct twin *twin,
		       uint64_t scans,
		       void (*take)(void *context, uint64_t after,
				    const struct act *act), void *context);
#endif
