/* SPDX-License-Identifier: MIT
 *
 * fbd - a body in Function Block Diagram (IEC 61131-3, 4.3; docs/fbd.md): networks, whose lines are
 * statements of pou->st.
 *
 * A target that is declared nowhere is a wire: a variable of the POU behind its own ones (VAR_WIRE), whose
 * name is that of the wire, `.N` and the number of its network. check/wires.c makes them.
 */
#ifndef MODEL_FBD_H
#define MODEL_FBD_H

#include "engine/model/expr.h"
#include "engine/model/project.h"
#include "engine/model/st.h"

struct fbd_network {
	uint32_t label, title, comment; /* string ids; 0: none               */
	bool off;
	int first, count;               /* of pou->st->item                   */
	int line;                       /* of the word NETWORK                */
	int wire, wires;                /* of pou->vars: those of this network (VAR_WIRE) */
};

struct fbd {
	struct fbd_network *network;
	int count;
};

/** fbd_network_of - the number of the network of item @item, from 0; -1: it is in none. Scan-safe: yes. */
int fbd_network_of(const struct fbd *fbd, int item);
/** fbd_find_label - the first network with the label @fold, a folded name; -1: none. Scan-safe: no. */
int fbd_find_label(struct names *names, const struct fbd *fbd, uint32_t fold);
/** fbd_wire_name - string id of the variable that wire @name of network @network (from 0) is; @before: of its
 * value at the end of the scan before. 0: no memory. Scan-safe: no. */
uint32_t fbd_wire_name(struct names *names, const char *name, size_t len, int network, bool before);
/** fbd_variable - index in pou->vars of the variable of network @network with this name; -1: it has none. */
int fbd_variable(struct names *names, const struct pou *pou, int network, uint32_t id);
/** fbd_wire - index in pou->vars of that variable; -1: the network has no such wire. Scan-safe: no. */
int fbd_wire(struct names *names, const struct pou *pou, int network, const char *name, size_t len);
/** fbd_hint - does the comment say where a box stands: { at 3,1 }? Scan-safe: yes. */
bool fbd_hint(const char *text, size_t len, uint8_t *column, uint8_t *row);
/* How a line uses a name. */
enum fbd_use {
	FBD_READ,
	FBD_WRITTEN,   /* Name :=                                             */
	FBD_LATCHED,   /* Name S=, Name R=                                    */
	FBD_OUTPUT,    /* => Name                                             */
	FBD_BEFORE,    /* PREVIOUS(Name)                                      */
	FBD_CALLED,    /* Name(…) that begins the line                        */
	FBD_EDGE,      /* the word R_EDGE or F_EDGE                           */
};
/* The names of a line, without those of pins, functions and labels. */
struct fbd_names {
	struct lex lex;
	enum st_kind kind;
	struct token before, earlier; /* behind those                         */
	int open;
	bool stored;       /* behind := S= R=                                 */
	bool first;        /* the next name begins the line                   */
};
/** fbd_names_begin - before the first one of @item. Scan-safe: yes. */
void fbd_names_begin(struct fbd_names *walk, const struct names *names, const struct st_item *item);
/** fbd_names_next - the next name: its first part only, Delay of Delay.Q. @whole: gets whether that is all of
 * it. Scan-safe: yes. False: there is none. */
bool fbd_names_next(struct fbd_names *walk, struct token *name, enum fbd_use *use, bool *whole);
/** fbd_edge_number - which R_EDGE or F_EDGE of network @network (from 0) stands at byte @at of the text of item
 * @item, from 1. Scan-safe: yes. */
int fbd_edge_number(const struct names *names, const struct pou *pou, int network, int item, const char *at);
/** fbd_edge_name - string id of the variable that remembers what its value was. 0: no memory. */
uint32_t fbd_edge_name(struct names *names, int network, int number);
/* PREVIOUS(Wire), R_EDGE(value), F_EDGE(value). */
enum fbd_word { FBD_NO_WORD, FBD_PREVIOUS, FBD_RISING, FBD_FALLING };
/** fbd_word - which of them the EXPR_CALL is, with one argument; @arg gets that. Scan-safe: yes. */
enum fbd_word fbd_word(struct expr *expr, const struct expr_node *call, struct expr_node **arg);
#endif
