/* SPDX-License-Identifier: MIT
 *
 * plcopen_graph - a body that is drawn, as elements with pins and connections, and the order in
 * which its outputs act. Private to plcopen_*.c.
 *
 * References decide what is connected. Coordinates are read only where a reference does not say
 * which output it means, and for the order.
 */
#ifndef PLCOPEN_GRAPH_H
#define PLCOPEN_GRAPH_H

#include "engine/base/catalog.h"
#include "engine/exchange/plcopen/plcopen_convert.h"

enum plc_kind {
	PLC_LEFT, PLC_RIGHT, PLC_CONTACT, PLC_COIL, PLC_BLOCK, PLC_IN, PLC_OUT, PLC_INOUT,
	PLC_CONNECTOR, PLC_CONTINUATION, PLC_LABEL, PLC_JUMP, PLC_RETURN, PLC_STOP, PLC_COMMENT,
	PLC_STEP, PLC_MACRO, PLC_TRANSITION, PLC_JUMP_STEP, PLC_CHOICE, PLC_CHOICE_END,
	PLC_PARALLEL, PLC_PARALLEL_END, PLC_ACTIONS, PLC_OTHER
};

enum plc_edge { PLC_NO_EDGE, PLC_RISING, PLC_FALLING };
enum plc_storage { PLC_NO_STORAGE, PLC_SET, PLC_RESET };

struct plc_source { int element, output; }; /* output: of its outs; -1: its only one */

struct plc_pin {
	const char *name;       /* formal parameter; ""                         */
	struct xml_node *node;
	bool negated, hidden;
	enum plc_edge edge;
	enum plc_storage storage;
	const char *expression; /* in place; NULL: none                         */
	int first, sources;     /* of graph.source                              */
	int x, y;               /* of an output, in the drawing                  */
	int uses;               /* of an output: how many connections begin at it */
};

struct plc_element {
	enum plc_kind kind;
	struct xml_node *node;
	const char *id;         /* as it may stand in a name: localId if that is digits */
	long long number;       /* localId                                      */
	int x, y;
	long order;             /* executionOrderId; 0: none                    */
	const char *name;       /* variable, expression, label, type of a block */
	const char *instance;   /* of a block; NULL: none                       */
	const char *comment;    /* its documentation; ""                         */
	const char *code;       /* of a block EXECUTE: its Structured Text; NULL: none */
	bool negated;
	enum plc_edge edge;
	enum plc_storage storage;
	int first_in, ins, first_out, outs; /* of graph.pin                      */
	int component;          /* elements that wires join have the same number */
	bool busy;              /* in work: what leads back to it is a circle    */
};

/* What a block is here. */
enum plc_word { PLC_UNKNOWN, PLC_FUNCTION, PLC_FUNCTION_BLOCK, PLC_ACTION, PLC_EXECUTE };

struct plc_graph {
	struct plcopen_pou *pou;
	struct plc_element *element;
	int elements;
	struct plc_pin *pin;
	int pins;
	struct plc_source *source;
	int sources;
	struct plc_number { long long number; int element; } *by_number; /* sorted by localId */
	int *step;              /* elements that act, in their order             */
	int steps;
};

/**
 * plc_graph_read - the elements of a body, which are marked as taken
 * @content: the element FBD, LD or SFC
 *
 * Owns: c->arena.   Fails: false after a diagnostic.
 */
bool plc_graph_read(struct plcopen *c, struct plcopen_pou *pou, struct xml_node *content,
		    struct plc_graph *graph);
/** plc_condition_pin - the pin of a transition's condition that is drawn; NULL: it has none. */
struct plc_pin *plc_condition_pin(struct plcopen *c, struct plc_graph *graph,
				  struct xml_node *condition);
/** plc_word - what the type of a block is in this project. */
enum plc_word plc_word(const struct plcopen *c, const struct plc_graph *graph, const struct plc_element *block);
/** plc_catalog - the built-in function or block of this name; WORD_COUNT: none, or the project has
 * its own. */
enum word plc_catalog(const struct plcopen *c, const char *type);
/** plc_inputs - the pins of an element, as pointers into the graph. */
static inline struct plc_pin *plc_in(const struct plc_graph *graph,
				     const struct plc_element *element, int i)
{
	return &graph->pin[element->first_in + i];
}
static inline struct plc_pin *plc_out(const struct plc_graph *graph,
				      const struct plc_element *element, int i)
{
	return &graph->pin[element->first_out + i];
}
/** plc_input - the input of this name; NULL: none. */
struct plc_pin *plc_input(const struct plc_graph *graph, const struct plc_element *element,
			  const char *name);
struct plc_pin *plc_output(const struct plc_graph *graph, const struct plc_element *element,
			   const char *name);
/** plc_connector - the connector that a continuation goes on from; NULL: none. */
struct plc_element *plc_connector(const struct plc_graph *graph,
				  const struct plc_element *continuation);

/* ---- plcopen_lines.c: a graph as statements ---- */

/* Where statements go. */
struct plc_lines {
	struct plcopen *c;
	struct plc_graph *graph;
	bool networks;          /* a network of FBD: wires, S=, JMP IF           */
	const char *indent;
	const char **wire;      /* of each output pin: its wire; NULL: none      */
	bool *done;             /* of each element: its call has begun           */
	bool *called;           /* of each function: its arguments are computed  */
	const char **guard;     /* of each function: the wire of its ENO, which decides whether others
				 * take its result; NULL: they always do          */
	bool unknown;           /* a block has a type that is not known          */
	bool failed;            /* a message is there                            */
	int work;               /* values computed so far                        */
};
bool plc_lines_init(struct plc_lines *lines, struct plcopen *c, struct plc_graph *graph,
		    bool networks, const char *indent);
/** plc_lines_step - the statements of one element that acts. */
void plc_lines_step(struct plc_lines *lines, struct plc_element *element);
/** plc_lines_value - the expression of what leads into a pin; NULL: nothing does. */
const char *plc_lines_value(struct plc_lines *lines, struct plc_pin *pin);

/* ---- plcopen_parts.c: steps that belong together ---- */
struct plc_group {
	int first, count;       /* of graph.step; count 0: a label alone          */
	const char *label;      /* NULL: none                                    */
	int y;                  /* of the label                                  */
	struct xml_node *node;  /* its label, or its first element               */
	const char *comment;    /* ""                                            */
	const char *missing;    /* a type of a block that is not known; NULL: none */
};
struct plc_groups { struct plc_group *group; int count; };
/** plc_groups_make - steps that wires join, in order; a label begins a group. Reports what leads
 * nowhere. */
void plc_groups_make(struct plcopen *c, struct plc_graph *graph, struct plc_groups *groups);
/** plc_networks - all groups as networks or, if @st, as statements. */
void plc_networks(struct plcopen *c, struct plc_graph *graph, const struct plc_groups *groups,
		  bool st, const char *indent);

/* ---- plcopen_picture.c ---- */
/** plc_picture - where the elements of @group stand, as the drawing of rung or network c->rungs of the POU. */
void plc_picture(struct plcopen *c, const struct plc_graph *graph, const struct plc_group *group);

/* ---- plcopen_ladder.c ---- */
/** plc_ladder - all groups as rungs. false: not each of them can be one; nothing is written. */
bool plc_ladder(struct plcopen *c, struct plc_graph *graph, const struct plc_groups *groups,
		const char *indent);

/* ---- plcopen_sfc.c ---- */
void plc_chart(struct plcopen *c, struct plcopen_pou *pou);
#endif
