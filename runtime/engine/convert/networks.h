/* SPDX-License-Identifier: MIT
 *
 * networks - the wires of networks as variables, in texts of another language.
 *
 * Private to convert/: fbd_st.c defines them, for itself and for fbd_ladder.c.
 */
#ifndef CONVERT_NETWORKS_H
#define CONVERT_NETWORKS_H

#include "engine/convert/acts.h"
#include "engine/model/st.h"

/* A wire, or its value before, and its name as a variable. */
struct wire {
	uint32_t is;
	const struct var *var;
};

struct networks {
	struct acts *acts;
	const struct sink *sink;
	int network, item;     /* in work                                      */
	bool scoped;           /* wires of the network are names at present    */
	struct wire *wire;
	int wires;
};

/** networks_wire - the variable of a wire, or with @before of its value before; made at its first use. A string
 * id; 0: it is no wire. */
uint32_t networks_wire(struct networks *n, const char *name, size_t len, bool before);
/** networks_text - a part of an item. @before: gets the calls of its edges. Refuses edges that cannot stand
 * there (LD786). */
void networks_text(struct networks *n, const char *text, size_t len, const struct sink *sink,
		   const struct sink *before);
/** networks_statement - an item as a statement. */
void networks_statement(struct networks *n, const struct st_item *item, const struct sink *line,
			const struct sink *before);
/** networks_comment - the next comment inside of a line, from byte *@at of its text on; gets its begin there. The
 * length; 0: there is none. */
size_t networks_comment(const char *text, size_t len, size_t *at);
/** networks_kept - the next wire that PREVIOUS names; *@at: 0 at first. False: there is none. */
bool networks_kept(struct networks *n, int *at, uint32_t *before, uint32_t *wire, enum iec_type *type);
/**
 * networks_join - a BOOL that one line alone reads stands in that line
 * @item: the lines of @network, @count of them; those that are not needed any more become ST_EMPTY
 */
void networks_join(struct acts *acts, int network, struct st_item *item, int count);
/** networks_lead - does a JMP lead to @label? */
bool networks_lead(const struct networks *n, uint32_t label);
/** networks_declare - the variables of wires. */
void networks_declare(const struct networks *n, const struct sink *sink);
#endif
