/* SPDX-License-Identifier: MIT
 *
 * canvas - what the sheets of ladders and of charts share: scrolling, zoom, the popup that
 * asks for a line, keys, the pointer, and the children that assistive technology sees.
 *
 * Each kind of sheet is a subclass. It says how large it is, where its cursor is and what
 * keys and clicks mean; the canvas calls the functions of its class. The canvas itself knows
 * neither rungs nor steps, and changes no document.
 *
 * Places are in "px at 100 %", of the sheet, or in "px of the widget", on the screen.
 *
 * Signals:
 *   cursor-moved ()
 *   told (const char *text)  why something was not done, or what the next key does
 *   zoom-changed ()
 */
#ifndef EDITOR_CANVAS_H
#define EDITOR_CANVAS_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/kit/lettering.h"
#include "editor-gtk/kit/theme.h"
#include "editor-gtk/kit/verbs.h"
#include "editor-gtk/sim/sim.h"

#include "engine/xref/xref.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_CANVAS (ladder_canvas_get_type())
G_DECLARE_DERIVABLE_TYPE(LadderCanvas, ladder_canvas, LADDER, CANVAS, GtkWidget)

/* What subclasses read; the canvas alone sets it. */
struct canvas_state {
	LadderDocument *document;
	int pou;
	LadderSim *sim;               /* NULL: none was given                      */
	double zoom;
	struct lettering *lettering;
	GtkAdjustment *adjustment[2]; /* horizontal, vertical                      */
	GtkWidget *entry;             /* the popup while it is open; NULL           */
};

/* What an accessible child stands for, in the numbers of the sheet. */
struct canvas_spot {
	int number, row, col;
};

struct _LadderCanvasClass {
	GtkWidgetClass parent_class;
	double least_zoom;
	enum verb_where keys;     /* the verbs whose keys the sheet has            */
	const char *name;         /* of the widget, for assistive technology; N_() */

	/* ---- what is drawn ---- */
	/** Size of the sheet with the free margin behind it, px at 100 %. */
	graphene_size_t (*size)(LadderCanvas *canvas);
	/** Lays out what a page of @page px shows. NULL: the size is always known. */
	void (*lay_out)(LadderCanvas *canvas, double page);
	/** After it scrolled and before it is drawn. NULL: nothing to do. */
	void (*scrolled)(LadderCanvas *canvas);
	void (*paint)(LadderCanvas *canvas, GtkSnapshot *snapshot, const struct theme *theme);
	/** Colours, the focus or the zoom changed: drop drawings. NULL: there are none. */
	void (*restyle)(LadderCanvas *canvas);

	/* ---- the cursor ---- */
	/** Where it is, px at 100 %. */
	graphene_rect_t (*cursor_box)(LadderCanvas *canvas);
	/** Scrolls until it is seen, by canvas_reveal(). */
	void (*reveal)(LadderCanvas *canvas);
	/** Its name. @values: with the values of a running program; without, the text must
	 * tell it from any other place. NULL: nothing is there. Caller frees. */
	char *(*cursor_name)(LadderCanvas *canvas, bool values);

	/** "Rung 3 · column C", for the status bar. Caller frees. */
	char *(*place)(LadderCanvas *canvas);
	/** "Enter: Edit operand · /: Negate": what the next key could do. Caller frees. */
	char *(*next_keys)(LadderCanvas *canvas);

	/* ---- keys and the pointer; x, y: px of the widget ---- */
	/** A verb of the rows that `keys` names. */
	void (*do_verb)(LadderCanvas *canvas, enum verb verb);
	/** A key that moves the cursor; false: it is another key. */
	bool (*key)(LadderCanvas *canvas, guint key, GdkModifierType state);
	/** Does a typed letter begin an entry? */
	bool (*begins_entry)(LadderCanvas *canvas, gunichar letter);
	/** Begins an entry with @text. */
	void (*type)(LadderCanvas *canvas, const char *text);
	void (*press)(LadderCanvas *canvas, double x, double y, int count,
		      GdkModifierType state);
	/** The button went up. NULL: that means nothing. @moved: it was a drag. */
	void (*release)(LadderCanvas *canvas, double x, double y, int count, bool moved);
	/** May a drag begin where the button went down? */
	bool (*can_drag)(LadderCanvas *canvas);
	/** The pointer goes on with the button down; false: it means nothing there. */
	bool (*drag)(LadderCanvas *canvas, double x, double y, GdkModifierType state);
	/** @cancelled: it ended without effect. */
	void (*drag_end)(LadderCanvas *canvas, bool cancelled);
	/** The menu of what the cursor is on. Caller unrefs. */
	GMenu *(*menu)(LadderCanvas *canvas);
	/** What to say of a point, or of the cursor (@by_keys). NULL: nothing. Caller frees. */
	char *(*tip)(LadderCanvas *canvas, int x, int y, bool by_keys);
	/** The popup closed, or would if it was open. NULL: nothing to do. */
	void (*closed)(LadderCanvas *canvas, bool was_open);

	/* ---- accessible children ---- */
	/** Calls canvas_add_cell() for all that is on the screen. */
	void (*list_cells)(LadderCanvas *canvas);
	/** NULL: nothing stands there any more. Caller frees. */
	char *(*cell_name)(LadderCanvas *canvas, struct canvas_spot spot);
	/** Px at 100 %; false: it is not laid out, or gone. */
	bool (*cell_box)(LadderCanvas *canvas, struct canvas_spot spot, graphene_rect_t *box);
	void (*go_to_cell)(LadderCanvas *canvas, struct canvas_spot spot);

	/* ---- the document and the simulation ---- */
	void (*project_changed)(LadderCanvas *canvas);
	void (*rungs_changed)(LadderCanvas *canvas, int pou, int at, int removed,
			      int inserted);
	/** NULL, as bookmarks_changed: the sheet does not show this. */
	void (*variable_changed)(LadderCanvas *canvas, int pou, const char *name,
				 const char *address);
	void (*bookmarks_changed)(LadderCanvas *canvas);
	void (*checked)(LadderCanvas *canvas);
	/** The simulation shows other values. */
	void (*values_changed)(LadderCanvas *canvas);
	/** Another program runs, or none. */
	void (*program_changed)(LadderCanvas *canvas);
	/** It started, stopped, paused. NULL: as values_changed. */
	void (*state_changed)(LadderCanvas *canvas);
};

/* ---- for everybody ---- */

/** ladder_canvas_pou - the POU that is shown; its document. Borrowed. */
int ladder_canvas_pou(LadderCanvas *canvas);
LadderDocument *ladder_canvas_document(LadderCanvas *canvas);
/** ladder_canvas_set_pou - after POUs were added or removed before it. */
void ladder_canvas_set_pou(LadderCanvas *canvas, int pou);
/** ladder_canvas_set_sim - shows what @sim runs; NULL: nothing. A reference is kept. */
void ladder_canvas_set_sim(LadderCanvas *canvas, LadderSim *sim);
/** ladder_canvas_do - a verb of the sheet. */
void ladder_canvas_do(LadderCanvas *canvas, enum verb verb);
/** ladder_canvas_place - where the cursor is; ladder_canvas_next_keys - what the next key
 * could do there. Caller frees. */
char *ladder_canvas_place(LadderCanvas *canvas);
char *ladder_canvas_next_keys(LadderCanvas *canvas);
double ladder_canvas_zoom(LadderCanvas *canvas);
/** ladder_canvas_set_zoom - up to 3; a cursor that is seen stays in sight. */
void ladder_canvas_set_zoom(LadderCanvas *canvas, double zoom);

/* ---- for subclasses ---- */

/** canvas_state - lives as long as the widget. Borrowed. */
const struct canvas_state *canvas_state(LadderCanvas *canvas);
/** canvas_show - shows POU @pou of @document; once, when the widget is new. */
void canvas_show(LadderCanvas *canvas, LadderDocument *document, int pou);
/** canvas_is_fixed - is it the program before an edit? Then it says that this cannot be
 * changed. */
bool canvas_is_fixed(LadderCanvas *canvas);
/** canvas_is_live - does a program run, or stand, whose values can be shown? */
bool canvas_is_live(LadderCanvas *canvas);
/** canvas_uses - the cross reference of the project as it is; NULL: no memory, or no
 * project. Borrowed until something changes. */
struct xref *canvas_uses(LadderCanvas *canvas);
/** canvas_tell - emits "told". */
void canvas_tell(LadderCanvas *canvas, const char *text);
/** canvas_moved - emits "cursor-moved"; accessible children and input methods follow. */
void canvas_moved(LadderCanvas *canvas);
/** canvas_theme - light or dark, with more contrast or not, as the desktop is now. */
const struct theme *canvas_theme(LadderCanvas *canvas);
/** canvas_point - px of the widget become px at 100 %. */
graphene_point_t canvas_point(LadderCanvas *canvas, double x, double y);
/** canvas_rect - px at 100 % become px of the widget. */
graphene_rect_t canvas_rect(LadderCanvas *canvas, graphene_rect_t box);
/** canvas_page - what is on the screen, px at 100 %. */
graphene_rect_t canvas_page(LadderCanvas *canvas);
/** canvas_reveal - scrolls until @box, px at 100 %, is seen, with @aside px of the widget
 * to its left and right, @above over and under it. Before the widget has a size: then. */
void canvas_reveal(LadderCanvas *canvas, graphene_rect_t box, double aside, double above);
/** canvas_show_menu - the menu of what the cursor is on, at the cursor. */
void canvas_show_menu(LadderCanvas *canvas);
/** canvas_end_drag - no drag goes on, and the sheet scrolls no more. */
void canvas_end_drag(LadderCanvas *canvas);
/** canvas_scroll_at_edge - something is dragged to (@x, @y), px of the widget: near an edge
 * the sheet scrolls, until it is elsewhere, and calls @again with the same place in each
 * step. */
void canvas_scroll_at_edge(LadderCanvas *canvas, double x, double y, GdkModifierType state,
			   void (*again)(LadderCanvas *canvas, double x, double y,
					 GdkModifierType state));
/** canvas_snapshot_hint - what an empty sheet says, at a point in px of the widget. */
void canvas_snapshot_hint(LadderCanvas *canvas, GtkSnapshot *snapshot,
			  const struct theme *theme, const char *text,
			  graphene_point_t at);

/* A line that is asked for at the cursor. */
struct canvas_question {
	const char *prompt;
	const char *text;       /* that stands there at first                      */
	bool typed;             /* by the person: it is not selected                 */
	bool proposes;          /* a click elsewhere takes it, too                   */
	bool drops;             /* and drops what cannot be taken, without a word    */
	/** Adds candidates to the popup (canvas_state.entry); as in entry_popup.h. */
	char *(*changed)(void *context, const char *line, int cursor, bool *good);
	bool (*taken)(void *context, const char *line);
	void *context;          /* taken over                                      */
	GDestroyNotify free;    /* of it, when something else is asked, or at the end */
};
/** canvas_ask - opens the popup at the cursor. What was open is closed. */
void canvas_ask(LadderCanvas *canvas, const struct canvas_question *question);
/** canvas_close_entry - closes the popup without taking its line. */
void canvas_close_entry(LadderCanvas *canvas);

/** canvas_add_cell - in list_cells: one more child. @current: the cursor is on it. */
void canvas_add_cell(LadderCanvas *canvas, struct canvas_spot spot, bool current);
/** canvas_set_blank - in list_cells: the cursor is on a place without a cell, of this name;
 * NULL: it is not. */
void canvas_set_blank(LadderCanvas *canvas, const char *name);
/** canvas_cells_later - the accessible children follow in a moment. */
void canvas_cells_later(LadderCanvas *canvas);
/** canvas_cells_rename - those that there are get the names that they have now. */
void canvas_cells_rename(LadderCanvas *canvas);
/** canvas_say_again - another thing is at the cursor, though it may have the same name. */
void canvas_say_again(LadderCanvas *canvas);

#endif
