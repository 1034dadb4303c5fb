/* SPDX-License-Identifier: MIT
 *
 * read_sfc - what the files that read a chart share.
 *
 * Only text/read_sfc*.c include it.
 */
#ifndef TEXT_READ_SFC_H
#define TEXT_READ_SFC_H

#include "engine/text/reader.h"

struct sfc_reader {
	struct reader *r;
	struct pou *pou;
	struct sfc *sfc;
	int macro, depth;     /* the macro-step in work; -1: none              */
	bool controlled;      /* a CONTROL was read                            */
};

/** is_end - does a line begin here that ends an piece, or the whole chart? RUNG and
 * VAR, which are misplaced in some of them, do not. */
bool is_end(const struct sfc_reader *in);
/** skip_odd - says that a line does not belong here, and skips it; of a rung its
 * rows, too. */
void skip_odd(struct sfc_reader *in);
/** expect_word - steps over a symbol or word. Fails: false and a diagnostic. */
bool expect_word(struct sfc_reader *in, const char *symbol);
/** read_settings - `(WORD := value, …)`; @one reads one of them, from its word to what
 * is behind its value. Fails: false and a diagnostic. */
bool read_settings(struct sfc_reader *in,
		   bool (*one)(struct sfc_reader *in, void *out), void *out);
/** read_value - a value, for @word; with @constant perhaps a constant. Steps behind
 * it. Fails: false and a diagnostic, also if @id has one already. */
bool read_value(struct sfc_reader *in, bool constant, const struct token *word,
		uint32_t *id);
/** read_setting - the same behind `WORD :=`. */
bool read_setting(struct sfc_reader *in, bool constant, uint32_t *id);
/** read_number - `WORD := number`, from 1 to @most. */
bool read_number(struct sfc_reader *in, int most, int *out);
/** close_head - steps over END_…, which must stand here; @head: what it ends. */
void close_head(struct sfc_reader *in, const char *end, const struct token *head);
/** read_body - rungs or a list, up to what ends them. */
void read_body(struct sfc_reader *in, struct sfc_body *body);
/** push_room - room in a vector of the chart, and a diagnostic if it is full or there
 * is no memory; NULL then. */
void *push_room(struct sfc_reader *in, void *vector, int *count, size_t size, int most,
		const char *what);
void add_piece(struct sfc_reader *in, enum piece_kind kind, int index);

/** read_step - STEP, INITIAL_STEP or MACRO_STEP with its lines; of a macro-step not what
 * is inside. */
void read_step(struct sfc_reader *in);
/** read_step_end - END_STEP of the macro-step in work. */
void read_step_end(struct sfc_reader *in);
/** read_transition - from TRANSITION to END_TRANSITION. */
void read_transition(struct sfc_reader *in);
#endif
