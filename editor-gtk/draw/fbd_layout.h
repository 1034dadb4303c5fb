/* SPDX-License-Identifier: MIT
 *
 * fbd_layout - the places of everything in a network of a function block diagram, and the part at a point.
 *
 * Columns and rows are those of the engine's plan (show/fbd_plan.h); here they get pixels, a heading
 * and the gutter, as a rung has them. Places are px at 100 %, from the upper left corner of the network's
 * strip; the caller applies the zoom. It draws nothing.
 */
#ifndef EDITOR_FBD_LAYOUT_H
#define EDITOR_FBD_LAYOUT_H

#include "editor-gtk/draw/rung_layout.h"
#include "engine/base/diag.h"
#include "engine/show/fbd_plan.h"

/* px at 100 % */
#define FBD_ROW    22     /* from pin to pin                                  */
#define FBD_HEAD   33     /* from the top of a box to its first pin           */
#define FBD_FOOT   19     /* from its last pin to its bottom                  */
#define FBD_END    13     /* half the height of a store                       */
#define FBD_CIRCLE 4      /* radius at a negated pin                          */
#define FBD_STUB   16     /* from a text in place to the pin                  */
#define FBD_OPEN   40     /* width of the place for one                       */
#define FBD_TYPE_BOUND 280
#define FBD_PIN_BOUND  140
#define FBD_VALUE_BOUND 60 /* of a value above a wire                          */

struct fbd_network;

struct fbd_layout {
	const struct fbd_network *network; /* borrowed (model/fbd.h)            */
	bool off;
	int index, number;       /* of the network, from 0; shown, from 1       */
	struct fbd_graph graph;
	struct fbd_plan plan;
	float left, top;         /* where the plan begins: x 0, row 0            */
	float width, height;     /* of the whole strip                          */
	float title_y;           /* baseline of title and number                */
	struct lettered label, title;
	float title_x, note_y;   /* baseline of the first comment               */
	char **note;             /* lines of comments, without delimiters, up to NULL */
	struct lettering *lettering;
};

/** fbd_layout_new - network @index (from 0) of a POU in FBD. Owns: the caller, fbd_layout_free(); @project
 * and @pou must outlive it. */
struct fbd_layout *fbd_layout_new(const struct project *project, const struct pou *pou, int index,
				  struct lettering *lettering);
void fbd_layout_free(struct fbd_layout *layout);

/** fbd_layout_networks - how many a POU in FBD has. */
int fbd_layout_networks(const struct pou *pou);
/** fbd_layout_text - the heading and lines of a network as one text, to compare networks. Owns: the caller, g_free(). */
char *fbd_layout_text(const struct project *project, const struct pou *pou, int index);

/** fbd_operand_letter - constants are set as values, names as symbols. */
enum letter fbd_operand_letter(const char *operand);
/** fbd_is_constant - is it no name? */
bool fbd_is_constant(const char *operand);

/** fbd_layout_y - the middle of a row of the plan. */
float fbd_layout_y(const struct fbd_layout *layout, int row);
/** fbd_layout_box - the frame of a box; of a value in place of a wire its text. */
graphene_rect_t fbd_layout_box(const struct fbd_layout *layout, int box);
/** fbd_layout_pin - where a pin meets its box. */
graphene_point_t fbd_layout_pin(const struct fbd_layout *layout, int pin);
/** fbd_layout_operand - the text at a pin, or the place for one. */
graphene_rect_t fbd_layout_operand(const struct fbd_layout *layout, int pin);
/** fbd_layout_can_part - may a page end below row @row of the plan, without cutting a box? */
bool fbd_layout_can_part(const struct fbd_layout *layout, int row);
/** fbd_layout_hint - the column and row, from 1, of { at } for a box whose upper left corner is at a point. */
void fbd_layout_hint(const struct fbd_layout *layout, int box, float x, float y, int *column, int *row);

enum fbd_part { FBD_PART_NONE, FBD_PART_NUMBER, FBD_PART_TITLE, FBD_PART_BOX, FBD_PART_PIN, FBD_PART_OPERAND,
		FBD_PART_WIRE };
struct fbd_hit {
	enum fbd_part part;
	int box;           /* of BOX, PIN, OPERAND; else -1                        */
	int pin;           /* of PIN, OPERAND; of WIRE the output it comes from     */
	int wire;          /* of WIRE: index in the graph                           */
};
/** fbd_layout_hit - the part at a point, within @slack px. */
struct fbd_hit fbd_layout_hit(const struct fbd_layout *layout, float x, float y, float slack);
/** fbd_layout_of_diag - the part of a diagnostic of this POU, by its line and column. @pin: -1: the box.
 * Fails: false: it belongs to no part of the network. */
bool fbd_layout_of_diag(const struct fbd_layout *layout, const struct diag *diag, int *box, int *pin);

#endif
