/* SPDX-License-Identifier: MIT
 *
 * read_sfc - what the files that read a chart share.
 *
 * Only text/read_sfc*.c include it.
 */
#ifndef TEXT_READ_SFC_H
#define TEXT_READ_SFC_H

#include "engine/text/reader.h"

struct chart {
	struct reader *r;
	struct pou *pou;
	struct sfc *sfc;
	int macro, depth;     /* the macro-step in work; -1: none              */
	bool controlled;      /* a CONTROL was read                            */
};

/** chart_ends - does a line begin here that ends an piece, or the whole chart? RUNG and
 * VAR, which are misplaced in some of them, do not. */
bool chart_ends(const struct chart *chart);
/** chart_skip_odd - says that a line does not belong here, and skips it; of a rung its
 * rows, too. */
void chart_skip_odd(struct chart *chart);
/** chart_expect - steps over a symbol or word. Fails: false and a diagnostic. */
bool chart_expect(struct chart *chart, const char *symbol);
/** chart_settings - `(WORD := value, …)`; @one reads one of them, from its word to what
 * is behind its value. Fails: false and a diagnostic. */
bool chart_settings(struct chart *chart,
		    bool (*one)(struct chart *chart, void *out), void *out);
/** chart_operand - a value, for @word; with @constant perhaps a constant. Steps behind
 * it. Fails: false and a diagnostic, also if @id has one already. */
bool chart_operand(struct chart *chart, bool constant, const struct token *word,
		   uint32_t *id);
/** chart_setting - the same behind `WORD :=`. */
bool chart_setting(struct chart *chart, bool constant, uint32_t *id);
/** chart_number - `WORD := number`, from 1 to @most. */
bool chart_number(struct chart *chart, int most, int *out);
/** chart_close - steps over END_…, which must stand here; @head: what it ends. */
void chart_close(struct chart *chart, const char *end, const struct token *head);
/** chart_body - rungs or a list, up to what ends them. */
void chart_body(struct chart *chart, struct sfc_body *body);
/** chart_push - room in a vector of the chart, and a diagnostic if it is full or there
 * is no memory; NULL then. */
void *chart_push(struct chart *chart, void *vector, int *count, size_t size, int most,
		 const char *what);
void chart_add_piece(struct chart *chart, enum piece_kind kind, int index);

/** read_step - STEP, INITIAL_STEP or MACRO_STEP with its lines; of a macro-step not what
 * is inside. */
void read_step(struct chart *chart);
/** read_step_end - END_STEP of the macro-step in work. */
void read_step_end(struct chart *chart);
/** read_transition - from TRANSITION to END_TRANSITION. */
void read_transition(struct chart *chart);
#endif
