/* SPDX-License-Identifier: MIT
 *
 * plcopen_out - functions that the files of the export share. Private to plcopen_out*.c and
 * plcopen_write*.c.
 */
#ifndef PLCOPEN_OUT_H
#define PLCOPEN_OUT_H

#include "engine/base/sink.h"
#include "engine/exchange/plcopen/plcopen_write.h"

#include <stdint.h>

struct out {
	struct project *project;
	struct classic_report *report;
	struct arena *arena;
	struct sink_memory text;
	struct sink sink;
	int depth;              /* elements that are open                         */
	const struct pou *pou;  /* in work; NULL: none                            */
	int ids;                /* localIds given in this body                    */
	const char *coil;       /* the name of coils TRANSITION; NULL: as written  */
	int order;              /* executionOrderIds given in this body           */
	struct out_place { int x, y; } *place; /* by localId: where connections with its element end */
	int places;
	int at_x, at_y;         /* of the element in work                         */
	int outputs;            /* that it has so far                             */
	bool numbered;          /* the elements of this body have their numbers     */
	int y;                  /* where the next rung or network begins          */
	uint8_t *used;          /* by POU and global variable: does its body name it? */
	uint64_t *digest;       /* of each POU: that of its element; 0: it has none */
};

/** plco_open - begins an element on a line of its own; @format: its name and attributes, which
 * need no escapes. */
void plco_open(struct out *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
/** plco_line - the same of an element without content. */
void plco_line(struct out *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
void plco_close(struct out *out, const char *name);
/** plco_named - begins, or, if @empty, is, an element with one attribute of any text. */
void plco_named(struct out *out, const char *element, const char *attribute, const char *value,
	       bool empty);
/** plco_text - <name>…</name> with any text. */
void plco_text(struct out *out, const char *name, const char *text);
/** plco_escape - text of an attribute or element. */
void plco_escape(struct out *out, const char *text);
/** plco_formatted - <name><xhtml:p>…</xhtml:p></name> with lines as they are. */
void plco_formatted(struct out *out, const char *name, const char *text);
/** plco_documentation - the same of a comment with its delimiters; nothing for "". */
void plco_documentation(struct out *out, const char *comment);
/** plco_bare - comments without their delimiters; in the arena. */
const char *plco_bare(struct out *out, const char *comment);
/** plco_is_action - is it an action of the POU in work, or, as Other.Name, of another one? */
bool plco_is_action(struct out *out, const char *name);
/** plco_place - connections with the element @id end at this place. */
void plco_place(struct out *out, int id, int x, int y);
/** plco_position - where the element in work stands. */
void plco_position(struct out *out, int x, int y);
/** plco_output - an output pin of the block in work, which is @width wide. Beremiz wants its place. */
void plco_output(struct out *out, const char *name, bool negated, int width);
/** plco_connection - a connection with the output @pin of @id; NULL: its only one. Tools that draw the line, and
 * Beremiz also where it translates, need its two ends. */
void plco_connection(struct out *out, int id, const char *pin);
/** plco_numbers - @text with UDINT_TO_REAL instead of DWORD_TO_REAL if that means the same in this project
 * alone, as in files of CODESYS; in the arena. */
const char *plco_numbers(struct out *out, const char *text);
/** plco_words - the same, and names without their namespaces, which the format does not have; in the arena. */
const char *plco_words(struct out *out, const char *text);
/** plco_lost - a line of the report. */
void plco_lost(struct out *out, enum report_kind kind, int line, int rung, const char *text, ...)
	__attribute__((format(printf, 5, 6)));
/** plco_id - the string of an id. */
const char *plco_id(const struct out *out, uint32_t id);
/** plco_print - formatted text in the arena; "" without memory. */
const char *plco_print(struct out *out, const char *format, ...)
	__attribute__((format(printf, 2, 3)));

/* ---- plcopen_write_types.c ---- */
/** plco_type - <name>…</name> with the type of @var. */
void plco_type(struct out *out, const char *name, const struct var *var);
/** plco_type_is_named - has its type no list of values and no range of its own? Another declaration can have the
 * same type then. */
bool plco_type_is_named(struct out *out, const struct var *var);
/** plco_initial - its initial value; nothing if it has none. */
void plco_initial(struct out *out, const struct var *var);
/** plco_variables - all blocks of a table, as lists of an interface. */
void plco_variables(struct out *out, const struct var_table *table);
/** plco_block - one block as the list @element. */
void plco_block(struct out *out, const struct var_table *table, int block, const char *element);
void plco_types(struct out *out);

/* ---- plcopen_write_body.c ---- */
/** plco_rungs - rungs of a POU as elements of a drawing. */
void plco_rungs(struct out *out, const struct pou *pou, int first, int count);
/* ---- plcopen_write_fbd.c ---- */
/** plco_networks - the networks of a body. */
void plco_networks(struct out *out, const struct pou *pou);
/* ---- plcopen_write_sfc.c ---- */
void plco_chart(struct out *out, const struct pou *pou);
/** plco_chart_actions - the actions inside of it. */
void plco_chart_actions(struct out *out, const struct pou *pou);
/** plco_chart_transitions - transitions that have a name. */
void plco_chart_transitions(struct out *out, const struct pou *pou);
/* ---- plcopen_write_own.c ---- */
/** plco_own - the project's own text, beside what the XML says. Nothing if it cannot stand there. */
void plco_own(struct out *out);
#endif
