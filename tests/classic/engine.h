/* SPDX-License-Identifier: MIT
 *
 * engine - a second evaluator of ClassicLadder projects, written from the facts of
 * ClassicLadder, to check the importer.
 *
 * It runs the cells of the files directly and uses nothing of the engine. It is slow: each
 * scan interprets the text of expressions.
 */
#ifndef CLASSIC_ENGINE_H
#define CLASSIC_ENGINE_H

#include "engine/exchange/classic/classic.h"

#include <stdint.h>

/* Codes of variables, as files have them. */
enum {
	V_BIT = 0, V_TIMER_D = 10, V_TIMER_R = 11, V_IEC_Q = 15, V_MONO_R = 20,
	V_COUNTER_D = 25, V_COUNTER_E = 26, V_COUNTER_F = 27, V_STEP_A = 30,
	V_INPUT = 50, V_OUTPUT = 60, V_LED = 65, V_SYSTEM = 70, V_ERROR = 75,
	V_REGISTER_E = 80, V_REGISTER_F = 81,
	V_WORD = 200, V_STEP_V = 220, V_TIMER_P = 230, V_TIMER_V = 231, V_MONO_P = 240,
	V_MONO_V = 241, V_COUNTER_P = 250, V_COUNTER_V = 251, V_IEC_P = 260, V_IEC_V = 261,
	V_INPUT_WORD = 270, V_OUTPUT_WORD = 280, V_SYSTEM_WORD = 290,
	V_REGISTER_I = 300, V_REGISTER_O = 301, V_REGISTER_S = 302,
	V_INPUT_FLOAT = 300, V_OUTPUT_FLOAT = 310 /* LinuxCNC                  */
};

struct old_timer { int32_t base, preset, value; bool done, running; };
struct monostable { int32_t base, preset, value; bool running, before; };
struct iec_timer { int32_t base, preset, value, rest; int mode; bool q, before; };
struct counter { int32_t preset, value, last; bool done, empty, full, up, down; };
struct fifo { int mode; int32_t in, out, put, get, count; bool push, pop, empty, full; };

struct engine {
	const struct classic_project *project;
	bool faithful;           /* with ClassicLadder's faults                */
	bool stopped;            /* after too many jumps                       */
	int scans;
	int32_t period;          /* ms, of this scan                           */
	int64_t now;             /* ms, when this scan began                   */
	uint8_t *bits;           /* of all kinds; faithful: in one array as in
				    ClassicLadder, where %Q15 can be %S0        */
	uint8_t *bit, *input, *output, *led, *system, *error, *step_a;
	int32_t *word, *input_word, *input_number, *output_word, *system_word, *step_v;
	struct old_timer *timer;
	struct monostable *mono;
	struct iec_timer *iec;
	struct counter *counter;
	struct fifo *fifo;
	int32_t *list;           /* values of all registers                    */
	int fifos;               /* registers that have values                 */
	bool *active;            /* by position in project->step               */
	int64_t *active_ms;
	uint8_t (*edge)[CLASSIC_ROWS][CLASSIC_COLUMNS]; /* by position         */
	int depth;               /* of calls                                   */
};

/** engine_new - @project must outlive it. NULL: no memory. */
struct engine *engine_new(const struct classic_project *project, bool faithful);
void engine_free(struct engine *engine);
/** engine_reset - sets all variables to 0, blocks and steps to their initial state. */
void engine_reset(struct engine *engine);
/** engine_scan - runs a scan that is @ms long. */
void engine_scan(struct engine *engine, int ms);
/** engine_get, engine_set - a variable by its code; outside: 0, and no effect. */
int32_t engine_get(const struct engine *engine, int type, int64_t number);
void engine_set(struct engine *engine, int type, int64_t number, int32_t value);
/** engine_at - the number of a variable with its index. */
int64_t engine_at(const struct engine *engine, const struct classic_variable *variable);
/** engine_compare, engine_operate - evaluates the text of an expression. */
bool engine_compare(struct engine *engine, const char *text);
void engine_operate(struct engine *engine, const char *text);
/** engine_block - runs a block. @in, @out: by row. */
void engine_block(struct engine *engine, int element, int number, const bool in[4],
		  bool out[4]);
/** engine_sfc - runs a sequential page. */
void engine_sfc(struct engine *engine, int page);
/** engine_name - code and number of "%TM0.Q". Returns its length; 0: it is no name. */
int engine_name(const struct engine *engine, const char *text, int *type, int *number);
/** engine_print - name of a code and number. */
void engine_print(const struct engine *engine, int type, int number, char *out,
		  size_t size);
#endif
