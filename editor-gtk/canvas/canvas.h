/* SPDX-License-Identifier: MIT
 *
 * canvas - the base class of the sheets of ladders and charts: scrolling, zoom, the entry,
 * keys, the pointer, accessible children.
 *
 * A subclass knows the size, the cursor and the meaning of keys and clicks; the canvas calls the
 * functions of its class. The canvas knows neither rungs nor steps, and changes no document.
 *
 * Places are in "px at 100 %", of the sheet, or in "px of the widget", on the screen.
 *
 * Signals:
 *   cursor-moved ()
 *   told (const char *text)  a message for the status bar: a refusal, or a hint
 *   zoom-changed ()
 */
#ifndef EDITOR_CANVAS_H
#define EDITOR_CANVAS_H

#include "editor-gtk/document/document.h"
#include "editor-gtk/edit/entry.h"
#include "editor-gtk/kit/lettering.h"
#include "editor-gtk/kit/theme.h"
#include "editor-gtk/kit/verbs.h"
#include "editor-gtk/sim/sim.h"

#include "engine/xref/xref.h"

#include <gtk/gtk.h>

#define LADDER_TYPE_CANVAS (ladder_canvas_get_type())
G_DECLARE_DERIVABLE_TYPE(LadderCanvas, ladder_canvas, LADDER, CANVAS, GtkWidget)

/* Read by subclasses, set by the canvas alone. */
struct canvas_state {
	LadderDocument *document;
	int pou;
	LadderSim *sim;               /* NULL: none                                */
	double zoom;
	struct lettering *lettering;
	GtkAdjustment *adjustment[2]; /* horizontal, vertical                      */
	GtkWidget *entry;             /* the popup while it is open; NULL           */
};

/* The thing that an accessible child stands for, in numbers of the subclass. */
struct canvas_spot {
	int number, row, col;
};

/* A point of the sheet that keeps its meaning while the zoom changes the layout. */
struct canvas_hold {
	int number, column;       /* of the subclass; -1: none                    */
	float x, y;               /* px at 100 % there; with a column x is a part of its width */
};

struct _LadderCanvasClass {
	GtkWidgetClass parent_class;
	double least_zoom;
	enum verb_where keys;     /* the verbs of this kind of sheet               */
	const char *name;         /* of the widget, for assistive technology; N_() */

	/* ---- drawing ---- */
	/** Size of the sheet with the free margin behind it, px at 100 %. */
	graphene_size_t (*size)(LadderCanvas *canvas);
	/** Lays out a page of @page px. NULL: the size is always known. */
	void (*lay_out)(LadderCanvas *canvas, double page);
	/** What is at a point, px at 100 %, and where that is now. NULL: the zoom changes no layout. */
	struct canvas_hold (*hold)(LadderCanvas *canvas, graphene_point_t at);
	graphene_point_t (*held)(LadderCanvas *canvas, const struct canvas_hold *hold);
	/** After scrolling and before drawing. NULL: nothing to do. */
	void (*scrolled)(LadderCanvas *canvas);
	void (*paint)(LadderCanvas *canvas, GtkSnapshot *snapshot, const struct theme *theme);
	/** Colours, the focus or the zoom changed: drop drawings. NULL: there are none. */
	void (*restyle)(LadderCanvas *canvas);

	/* ---- the cursor ---- */
	/** Where it is, px at 100 %. */
	graphene_rect_t (*cursor_box)(LadderCanvas *canvas);
	/** Scrolls to it by canvas_reveal(). */
	void (*reveal)(LadderCanvas *canvas);
	/** Its accessible name. @values: with values of the running program; without, the
	 * text must be unique on the sheet. NULL: no name. Caller frees. */
	char *(*cursor_name)(LadderCanvas *canvas, bool values);

	/** "Rung 3 · column C", for the status bar. Caller frees. */
	char *(*place)(LadderCanvas *canvas);
	/** "Enter: Edit operand · /: Negate": what the next key could do. Caller frees. */
	char *(*next_keys)(LadderCanvas *canvas);

	/* ---- keys and the pointer; x, y: px of the widget ---- */
	/** A verb of the rows that `keys` names. */
	void (*do_verb)(LadderCanvas *canvas, enum verb verb);
	/** A key that moves the cursor; false: another key. */
	bool (*key)(LadderCanvas *canvas, guint key, GdkModifierType state);
	/** Opens the entry with @text. Each printed character that is no key of a verb does, so
	 * that none is lost; the entry says what is wrong with it. */
	void (*type)(LadderCanvas *canvas, const char *text);
	void (*press)(LadderCanvas *canvas, double x, double y, int count,
		      GdkModifierType state);
	/** The button was released. NULL: nothing to do. @moved: after a drag. */
	void (*release)(LadderCanvas *canvas, double x, double y, int count, bool moved);
	/** May a drag begin at the last press? */
	bool (*can_drag)(LadderCanvas *canvas);
	/** The pointer moves with the button down; false: ignored there. */
	bool (*drag)(LadderCanvas *canvas, double x, double y, GdkModifierType state);
	/** @cancelled: the drag must have no effect. */
	void (*drag_end)(LadderCanvas *canvas, bool cancelled);
	/** The context menu of the cursor. Caller unrefs. */
	GMenu *(*menu)(LadderCanvas *canvas);
	/** The tooltip of a point, or of the cursor (@by_keys). NULL: none. Caller frees. */
	char *(*tip)(LadderCanvas *canvas, int x, int y, bool by_keys);
	/** The entry closes; @was_open: FALSE: it was closed. NULL: nothing to do. */
	void (*closed)(LadderCanvas *canvas, bool was_open);

	/* ---- accessible children ---- */
	/** Calls canvas_add_cell() for each visible thing. */
	void (*list_cells)(LadderCanvas *canvas);
	/** NULL: it is gone. Caller frees. */
	char *(*cell_name)(LadderCanvas *canvas, struct canvas_spot spot);
	/** Px at 100 %; false: not laid out, or gone. */
	bool (*cell_box)(LadderCanvas *canvas, struct canvas_spot spot, graphene_rect_t *box);
	void (*go_to_cell)(LadderCanvas *canvas, struct canvas_spot spot);

	/* ---- the document and the simulation ---- */
	void (*project_changed)(LadderCanvas *canvas);
	void (*rungs_changed)(LadderCanvas *canvas, int pou, int at, int removed,
			      int inserted);
	/** This and bookmarks_changed may be NULL: the sheet does not show them. */
	void (*variable_changed)(LadderCanvas *canvas, int pou, const char *name,
				 const char *address);
	void (*bookmarks_changed)(LadderCanvas *canvas);
	void (*checked)(LadderCanvas *canvas);
	/** After values of the simulation changed. */
	void (*values_changed)(LadderCanvas *canvas);
	/** The program was freed: forgets where its values were, and asks no other widget. */
	void (*program_gone)(LadderCanvas *canvas);
	/** After another program, or none, began to run, and all sheets have forgotten the one before. */
	void (*program_changed)(LadderCanvas *canvas);
	/** After start, stop, pause. NULL: as values_changed. */
	void (*state_changed)(LadderCanvas *canvas);
};

/* ---- for everybody ---- */

/** ladder_canvas_pou - the shown POU; ladder_canvas_document - its document. Borrowed. */
int ladder_canvas_pou(LadderCanvas *canvas);
LadderDocument *ladder_canvas_document(LadderCanvas *canvas);
/** ladder_canvas_set_pou - the number of the POU changed. */
void ladder_canvas_set_pou(LadderCanvas *canvas, int pou);
/** ladder_canvas_set_sim - shows the program of @sim; NULL: none. Keeps a reference. */
void ladder_canvas_set_sim(LadderCanvas *canvas, LadderSim *sim);
/** ladder_canvas_sim - borrowed; NULL: none. */
LadderSim *ladder_canvas_sim(LadderCanvas *canvas);
/** ladder_canvas_do - does a verb of the sheet. */
void ladder_canvas_do(LadderCanvas *canvas, enum verb verb);
/** ladder_canvas_place - the place of the cursor; ladder_canvas_next_keys - keys for it; for
 * the status bar. Caller frees. */
char *ladder_canvas_place(LadderCanvas *canvas);
char *ladder_canvas_next_keys(LadderCanvas *canvas);
double ladder_canvas_zoom(LadderCanvas *canvas);
/** ladder_canvas_set_zoom - up to 3; a visible cursor stays in sight. */
void ladder_canvas_set_zoom(LadderCanvas *canvas, double zoom);

/* ---- for subclasses ---- */

/** canvas_state - lives as long as the widget. Borrowed. */
const struct canvas_state *canvas_state(LadderCanvas *canvas);
/** canvas_show - shows POU @pou of @document; called once, by the constructor. */
void canvas_show(LadderCanvas *canvas, LadderDocument *document, int pou);
/** canvas_is_fixed - is the document the program before an edit, which is read-only? Tells so. */
bool canvas_is_fixed(LadderCanvas *canvas);
/** canvas_is_live - is there a simulation, running or not, with values to show? */
bool canvas_is_live(LadderCanvas *canvas);
/** canvas_uses - the cross reference of the present project; NULL: out of memory, or no
 * project. Borrowed until the next change. */
struct xref *canvas_uses(LadderCanvas *canvas);
/** canvas_acts - the value at @at is set, forced or released from the cursor next: if that is
 * refused, now or by a board later, the reason is shown at the cursor. @prompt: as of
 * canvas_refuse(); lives for ever. */
void canvas_acts(LadderCanvas *canvas, struct location at, const char *prompt);
/** canvas_tell - emits "told". */
void canvas_tell(LadderCanvas *canvas, const char *text);
/** canvas_moved - emits "cursor-moved"; accessible children and input methods follow. */
void canvas_moved(LadderCanvas *canvas);
/** canvas_theme - the colours that fit the desktop: light or dark, high contrast. */
const struct theme *canvas_theme(LadderCanvas *canvas);
/** canvas_point - converts px of the widget to px at 100 %. */
graphene_point_t canvas_point(LadderCanvas *canvas, double x, double y);
/** canvas_rect - converts px at 100 % to px of the widget. */
graphene_rect_t canvas_rect(LadderCanvas *canvas, graphene_rect_t box);
/** canvas_page - the visible part, px at 100 %. */
graphene_rect_t canvas_page(LadderCanvas *canvas);
/** canvas_reveal - scrolls until @box, px at 100 %, is visible, with @aside px of the widget
 * left and right, @above px over and under it. A widget without size does it later. */
void canvas_reveal(LadderCanvas *canvas, graphene_rect_t box, double aside, double above);
/** canvas_show_menu - opens the context menu at the cursor. */
void canvas_show_menu(LadderCanvas *canvas);
/** canvas_append_section - adds those of @verbs, up to VERB_COUNT, that apply to a menu. */
void canvas_append_section(LadderCanvas *canvas, GMenu *menu, const enum verb *verbs,
			   bool (*applies)(LadderCanvas *canvas, enum verb verb));
/** canvas_append_submenu - the same as a submenu @name, N_(); without any: nothing. */
void canvas_append_submenu(LadderCanvas *canvas, GMenu *menu, const char *name,
			   const enum verb *verbs,
			   bool (*applies)(LadderCanvas *canvas, enum verb verb));
/** canvas_end_drag - ends a drag, and the scrolling by canvas_scroll_at_edge(). */
void canvas_end_drag(LadderCanvas *canvas);
/** canvas_scroll_at_edge - a drag is at (@x, @y), px of the widget: near an edge the sheet
 * scrolls until the next call or canvas_end_drag(), and calls @again after each step. */
void canvas_scroll_at_edge(LadderCanvas *canvas, double x, double y, GdkModifierType state,
			   void (*again)(LadderCanvas *canvas, double x, double y,
					 GdkModifierType state));
/** canvas_snapshot_hint - draws the hint of an empty sheet at a point, px of the widget. */
void canvas_snapshot_hint(LadderCanvas *canvas, GtkSnapshot *snapshot,
			  const struct theme *theme, const char *text,
			  graphene_point_t at);

/* The prompt of the entry at the cursor, its first text, and how it closes. */
struct canvas_question {
	const char *prompt;
	const char *text;       /* in the entry at first                           */
	bool typed;             /* the person typed @text: it is not selected        */
	bool proposes;          /* a click elsewhere takes an unchanged text, too    */
	bool spells;            /* @text has operands: their addresses are spelled as the preferences
				   ask for; what is taken has them as files do */
	bool drops;             /* a click elsewhere drops a wrong text silently     */
	/** Adds candidates to the popup (canvas_state.entry); as in entry_popup.h. */
	char *(*changed)(void *context, const char *line, int cursor, bool *good);
	/** Takes the line. False: the entry stays open and shows what canvas_tell() said. */
	bool (*taken)(void *context, const char *line);
	void *context;          /* taken over                                      */
	GDestroyNotify free;    /* frees @context at the next question or the end    */
};
/** canvas_ask - opens the entry at the cursor and closes an open one. */
void canvas_ask(LadderCanvas *canvas, const struct canvas_question *question);
/** canvas_blame - underlines what is wrong in the line of the open entry, if anything is. */
void canvas_blame(LadderCanvas *canvas, const struct entry *entry);
/** canvas_refuse - opens an entry at the cursor that only says @why, as an error: what is typed
 * next must not change another cell. */
void canvas_refuse(LadderCanvas *canvas, const char *prompt, const char *why);
/** canvas_close_entry - closes the entry without taking its line. */
void canvas_close_entry(LadderCanvas *canvas);

/** canvas_add_cell - in list_cells: adds an accessible child. @current: at the cursor. */
void canvas_add_cell(LadderCanvas *canvas, struct canvas_spot spot, bool current);
/** canvas_set_blank - in list_cells: names the empty place at the cursor; NULL: the cursor is
 * on a cell. */
void canvas_set_blank(LadderCanvas *canvas, const char *name);
/** canvas_cells_later - updates the accessible children after a short delay. */
void canvas_cells_later(LadderCanvas *canvas);
/** canvas_cells_rename - updates only the names of the accessible children. */
void canvas_cells_rename(LadderCanvas *canvas);
/** canvas_say_again - announces the cursor again: another thing may have the same name. */
void canvas_say_again(LadderCanvas *canvas);

#endif
