/* SPDX-License-Identifier: MIT
 *
 * fbd_view_inside - the files of the widget fbd_view. A file may call only files before it:
 * cursor, live, edit, entry, fbd_view.c.
 */
#ifndef EDITOR_FBD_VIEW_INSIDE_H
#define EDITOR_FBD_VIEW_INSIDE_H

#include "editor-gtk/draw/fbd_draw.h"
#include "editor-gtk/edit/entry.h"
#include "editor-gtk/edit/fbd_lines.h"
#include "editor-gtk/fbd/fbd_view.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_map.h"

/* A place of the cursor. */
struct fbd_pos {
	int network;             /* -1: none                                    */
	int box;                 /* of its graph; -1: the heading               */
	int pin;                 /* of its graph; -1: the box itself            */
};

/* A network on the sheet. */
struct fbd_strip {
	struct fbd_layout *layout;
	float y;                 /* px at 100 % above it                        */
	bool *selected;          /* by box; NULL: none is                       */
	struct fbd_places *places; /* of the values of the program; NULL: not looked up */
};

/* A wire, or a box, that the pointer drags. */
struct fbd_stroke {
	struct fbd_pos from, to;  /* network -1: none                            */
	bool drawn;
	graphene_point_t at;     /* the pointer, px at 100 %                     */
	graphene_point_t by;     /* from the corner of the box to where it was pressed */
};

struct _LadderFbdView {
	LadderCanvas parent;
	const struct canvas_state *canvas;
	const struct ladder *of; /* the project that the strips are made of      */
	struct fbd_strip *strip;
	int count;
	float width, height;
	struct fbd_pos cursor;
	GArray *marks;           /* struct fbd_problem                          */
	GArray *found;           /* struct fbd_problem: hits of a search         */
	struct fbd_pos link;      /* a pin that waits for another one            */
	struct fbd_pos drop;      /* where a word of the palette would go          */
	struct fbd_stroke stroke;
	struct live_map *map;    /* of the running program; NULL: none           */
	LadderSim *results;      /* of a board: has those that no variable has; NULL: none */
	struct live_map *results_map; /* of it; NULL: none                      */
	guint64 results_version; /* of the document                             */
	bool ordered;            /* values have not come since the last act      */
	struct location ordered_at;
	union iec_value ordered_value;
};

struct fbd_problem {
	struct fbd_pos at;
	unsigned int marks;      /* enum mark                                   */
};

#define FBD_NOWHERE ((struct fbd_pos){ -1, -1, -1 })

/* ---- fbd_view_cursor.c: the shown networks and the cursor ---- */
/** fbd_pou - NULL: it is not in FBD now. */
struct pou *fbd_pou(LadderFbdView *view);
/** fbd_make_sheet - lays out the present networks; closes the entry. */
void fbd_make_sheet(LadderFbdView *view);
/** fbd_fresh - the same, if they are older than the project. */
void fbd_fresh(LadderFbdView *view);
void fbd_clear(LadderFbdView *view);
/** fbd_forget_places - after another program runs. */
void fbd_forget_places(LadderFbdView *view);
static inline bool fbd_is_same(struct fbd_pos a, struct fbd_pos b)
{
	return a.network == b.network && a.box == b.box && a.pin == b.pin;
}
/** fbd_graph_of - of a network. Borrowed until the next change. */
const struct fbd_graph *fbd_graph_of(LadderFbdView *view, int network);
/** fbd_box_at, fbd_pin_at - what a place is on; NULL: none. */
const struct fbd_box *fbd_box_at(LadderFbdView *view, struct fbd_pos at);
const struct fbd_pin *fbd_pin_at(LadderFbdView *view, struct fbd_pos at);
/** fbd_rect - of a place, px at 100 %. */
graphene_rect_t fbd_rect(LadderFbdView *view, struct fbd_pos at);
/** fbd_hit_at - the part at a point, px at 100 %; @part: gets what it is. */
struct fbd_pos fbd_hit_at(LadderFbdView *view, graphene_point_t point, float slack, enum fbd_part *part);
void fbd_reveal(LadderFbdView *view);
/** fbd_go - moves the cursor and scrolls to it. @extend: selects its old and new box. */
void fbd_go(LadderFbdView *view, struct fbd_pos at, bool extend);
/** fbd_step - to the nearest place in a direction. */
void fbd_step(LadderFbdView *view, int dx, int dy, bool extend);
/** fbd_select - selects all boxes of the network, or none. */
void fbd_select(LadderFbdView *view, bool all);
/** fbd_selection - struct fbd_spot of what is selected, else of the box at the cursor. Caller:
 * g_array_unref. */
GArray *fbd_selection(LadderFbdView *view);
/** fbd_spot_of - a place for an edit of its network. */
struct fbd_spot fbd_spot_of(LadderFbdView *view, struct fbd_pos at);
/** fbd_go_statement - to the box of a statement of a network that ends it. */
void fbd_go_statement(LadderFbdView *view, int network, int statement);

/* ---- fbd_view_live.c: the running program ---- */
/** fbd_live_look - the values of a network; false: nothing runs. */
bool fbd_live_look(LadderFbdView *view, int network, struct fbd_live *out);
/** fbd_live_variable - where the variable at a place is; type IEC_NONE: there is none. The result of a box and a
 * wire are no variables. @name: gets its name, which the caller frees; NULL: of no interest. */
struct location fbd_live_variable(LadderFbdView *view, struct fbd_pos at, char **name);
/** fbd_live_end - forgets what @view knows of the running program, @all: also the results of a board. */
void fbd_live_end(LadderFbdView *view, bool all);
/** fbd_live_watch - results of a board are computed only while @view is visible. */
void fbd_live_watch(LadderFbdView *view);
/** fbd_live_marks - adds what is forced or not good. */
void fbd_live_marks(LadderFbdView *view, int network, GArray *marks);
/** fbd_live_text - the value at a place, for a name. Caller frees; NULL: not known. */
char *fbd_live_text(LadderFbdView *view, struct fbd_pos at);

/* ---- fbd_view_edit.c: changes, and the clipboard ---- */
/** fbd_begin - an edit of a network; NULL: there is none. */
struct fbd_edit *fbd_begin(LadderFbdView *view, int network);
/** fbd_put - replaces the lines of a network by those of @edit (taken over) as a step @name of the history,
 * and moves the cursor to what was made. @good false: only tells the reason. */
bool fbd_put(LadderFbdView *view, struct fbd_edit *edit, int network, bool good, const char *name);
/** fbd_join - joins two pins of a network, in either order. */
bool fbd_join(LadderFbdView *view, struct fbd_pos a, struct fbd_pos b);
/** fbd_heading - the heading of a network becomes this one. */
bool fbd_put_heading(LadderFbdView *view, int network, const struct fbd_heading *heading, const char *name);
/** fbd_move_box - the box at a place stands at a point, px at 100 %, from now on. */
void fbd_move_box(LadderFbdView *view, struct fbd_pos at, graphene_point_t corner);
/** fbd_add_word - a box behind the cursor, or before the input there. @instance: of a block. */
bool fbd_add_word(LadderFbdView *view, const char *word, const char *instance);
/** fbd_add_block - the same with a new instance of a block. */
bool fbd_add_block(LadderFbdView *view, const struct word_row *row, const char *instance);
/** fbd_edit_do - a verb that changes or copies; false: another verb. */
bool fbd_edit_do(LadderFbdView *view, enum verb verb);

/* ---- fbd_view_entry.c: the entry ---- */
enum fbd_asked { FBD_ASK_HERE, FBD_ASK_ADD, FBD_ASK_INSERT, FBD_ASK_STORE, FBD_ASK_TITLE, FBD_ASK_LABEL,
		 FBD_ASK_COMMENT };
/** fbd_ask - opens the entry at the cursor. @typed: the first letters; NULL: the present text. */
void fbd_ask(LadderFbdView *view, enum fbd_asked what, const char *typed);

#endif
