/* SPDX-License-Identifier: MIT
 *
 * trace - the values of variables after each scan, as text.
 *
 * Lines for people and tests, CSV for spreadsheets, VCD for wave viewers. It reads an
 * image and writes to a sink.
 *
 *   12 t=120 Motor=1 Runout.ET=20.5      scan, time in ms, values
 *   13 t=130 Level=77!stale              a value of the I/O map that is not good
 */
#ifndef TRIAL_TRACE_H
#define TRIAL_TRACE_H

#include "engine/base/arena.h"
#include "engine/base/diag.h"
#include "engine/model/project.h"
#include "engine/scan/image.h"
#include "engine/base/sink.h"

enum trace_form { TRACE_LINES, TRACE_CSV, TRACE_VCD };

struct trace_column {
	const char *name;      /* in the trace's arena                       */
	const struct image *image; /* whose variable it is                    */
	struct location at;
	const struct var *named; /* declares it, with an enumeration; NULL: none */
	bool gone;             /* the image has no such variable now           */
	union iec_value last;  /* value shown last; 0 to begin with; a STRING's bytes are
			        * the trace's own */
	const char *bad;       /* its mark in the last line: see struct trace; NULL: it was good */
};

struct trace {
	struct arena arena;
	const struct image *image;
	const struct image *plant; /* set by the caller after trace_init: image for names
				    * such as plant.Level; or NULL */
	const struct sink *out;
	enum trace_form form;
	bool changes;          /* lines and CSV: only what changed           */
	struct project *project; /* set likewise, or NULL: values of enumerations get their names */
	const bool *stop;      /* set by the caller after trace_init, or NULL: when it is
			        * true, running scans ends */
	/* Set likewise, or NULL: what a value is that is not good, `stale` or `fault`; NULL: it is good.
	 * `Level=77!stale` in lines and CSV, a comment in VCD. The words live for ever. */
	const char *(*quality)(void *context, struct location at);
	void *quality_context;
	bool begun;            /* the head of CSV or VCD is written          */
	int64_t stamp_ns;      /* VCD: time written last                     */
	int64_t last_ns;       /* VCD: time of the last scan                 */
	struct trace_column *column;
	int count;
};

/**
 * trace_init - a trace without columns
 * @image, @out: borrowed while the trace is used
 *
 * Owns: the trace, trace_free().   Scan-safe: no.   Fails: never.
 */
void trace_init(struct trace *trace, const struct image *image,
		const struct sink *out, enum trace_form form, bool changes);
void trace_free(struct trace *trace);

/** trace_clear - no columns. */
void trace_clear(struct trace *trace);
/** trace_show_all - a column for every declared variable, instances pin by pin;
 * hidden ones left out. Fails: false when memory is out. */
bool trace_show_all(struct trace *trace);
/**
 * trace_show - columns for `Motor`, `%Q0..7`, `Lamp1..Lamp8`, `First..Last`
 *
 * A range counts up the number at the end of its first name. If the two names have no
 * common stem with numbers, it contains the declarations from one to the other.
 * Owns: nothing. Scan-safe: no. Fails: false and a diagnostic at @place.
 */
bool trace_show(struct trace *trace, const char *text, size_t len,
		struct diag_list *diags, struct diag place);

/** trace_again - the image has another program now: finds each variable by its name. One that
 * it does not have, or has with another type, stays at its last value. Fails: false: no
 * memory for a text. */
bool trace_again(struct trace *trace);
/**
 * trace_scan - shows the image after scan number @scan at @now_ns
 *
 * Scan-safe: no. Fails: never; errors of the sink are not seen here.
 */
void trace_scan(struct trace *trace, uint64_t scan, int64_t now_ns);
/** trace_note - a remark: `# text` (lines), $comment (VCD), nothing in CSV. */
void trace_note(struct trace *trace, const char *text, size_t len);
/** trace_stopped - whether the caller asked to stop. */
bool trace_stopped(const struct trace *trace);
/** trace_end - writes the head, if no scan did; for VCD, the time of the last scan. */
void trace_end(struct trace *trace);
#endif
