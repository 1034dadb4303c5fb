/* SPDX-License-Identifier: MIT
 *
 * canvas - the base class of all sheets; see canvas.h.
 *
 * GTK 4.8 makes only widgets accessible, so each visible thing has a child widget that draws
 * nothing. The child at the cursor is selected. GTK 4.8 does not announce an active descendant:
 * the sheet keeps the focus, and its description, which screen readers read, is the name of
 * the thing at the cursor. The children are updated later, never during allocation or
 * scrolling.
 *
 * Keys of verbs (verbs.h) come first, except while an input method composes: Space chooses a
 * Chinese name then. The composed text is drawn at the cursor; the result opens the entry.
 */
#include "editor-gtk/canvas/canvas.h"

#include "editor-gtk/document/spelled.h"

#include "editor-gtk/kit/entry_popup.h"
#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/theme.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/kit/settings.h"

#include <gtk/gtk.h>

enum { PROP_0, PROP_HADJUSTMENT, PROP_VADJUSTMENT, PROP_HPOLICY, PROP_VPOLICY };
enum { CURSOR_MOVED, TOLD, ZOOM_CHANGED, SIGNALS };
static guint signals[SIGNALS];

#define ZOOM_MOST  3.0
#define FOLLOW_MS  60  /* delay of accessible children                         */
#define COMPOSED   4   /* px around the composed text                          */
#define EDGE       28  /* px from an edge where a drag scrolls                 */
#define SLOWEST    3   /* px a step of this scrolling                          */
#define FASTEST    24
#define STEP_MS    30

struct canvas_cell {
	GtkWidget *widget;
	struct canvas_spot spot;
	char *name;
};

/* Accessible children. */
struct canvas_cells {
	GArray *cell;           /* of struct canvas_cell                       */
	guint listed;           /* number of them that list_cells() has added  */
	GtkWidget *blank;       /* for an empty place; NULL: not needed yet    */
	char *said;             /* last description, without values            */
	guint timer;
	int height;             /* px of the widget at the last allocation      */
};

/* The last press of the button. */
struct canvas_press {
	double x, y;            /* px of the widget                            */
	bool dragging;
	struct {
		guint timer;    /* 0: the sheet does not scroll                */
		double x, y;
		GdkModifierType state;
		void (*again)(LadderCanvas *canvas, double x, double y,
			      GdkModifierType state);
	} edge;
};

/* Input methods. */
struct canvas_input {
	GtkIMContext *method;
	gunichar key;           /* passed to the method                        */
	bool plain;             /* the method returned @key unchanged          */
	char *composed;         /* text so far; NULL: none                     */
};

/* What the pointer zooms about, until the next allocation. */
struct canvas_anchor {
	bool on;
	double x, y;            /* px of the widget                            */
	struct canvas_hold hold;
};

struct canvas_own {
	struct canvas_state state;
	struct canvas_anchor anchor;
	GtkScrollablePolicy policy[2];
	bool allocating;
	bool reveal;            /* scroll to the cursor at the next allocation  */
	double pinched_from;    /* the zoom when two fingers came; 0: there are none */
	const struct theme *theme; /* NULL: to be looked up                    */
	struct xref *xref;      /* NULL: not needed since the last change       */
	struct canvas_question question; /* of the open entry                   */
	bool taking;            /* question.taken() runs                       */
	char *refusal;          /* said by it, for the entry; NULL: none       */
	struct location acted_at; /* of canvas_acts()                           */
	const char *acted_as;   /* its prompt; NULL: nothing to be refused     */
	struct canvas_cells cells;
	struct canvas_press press;
	struct canvas_input input;
};

G_DEFINE_ABSTRACT_TYPE_WITH_CODE(LadderCanvas, ladder_canvas, GTK_TYPE_WIDGET,
	LadderCanvas_private_offset = g_type_add_instance_private(g_define_type_id,
		sizeof(struct canvas_own));
	G_IMPLEMENT_INTERFACE(GTK_TYPE_SCROLLABLE, NULL))

static struct canvas_own *own_of(LadderCanvas *canvas)
{
	return ladder_canvas_get_instance_private(canvas);
}

static struct canvas_state *state_of(LadderCanvas *canvas)
{
	return &own_of(canvas)->state;
}

const struct canvas_state *canvas_state(LadderCanvas *canvas)
{
	return state_of(canvas);
}

static LadderCanvasClass *class_of(LadderCanvas *canvas)
{
	return LADDER_CANVAS_GET_CLASS(canvas);
}

/* ---- messages ---- */

void canvas_tell(LadderCanvas *canvas, const char *text)
{
	struct canvas_own *own = own_of(canvas);

	if (own->taking) {
		g_free(own->refusal);
		own->refusal = text[0] ? g_strdup(text) : NULL;
	} else if (text[0] && !state_of(canvas)->entry) {
		spoken_say(GTK_WIDGET(canvas), text);
	}
	g_signal_emit(canvas, signals[TOLD], 0, text);
}

static bool is_older(LadderCanvas *canvas)
{
	LadderSim *sim = state_of(canvas)->sim;

	return sim && ladder_sim_older(sim, NULL) == state_of(canvas)->document;
}

bool canvas_is_fixed(LadderCanvas *canvas)
{
	if (!ladder_document_is_fixed(state_of(canvas)->document))
		return false;
	canvas_tell(canvas, is_older(canvas) ?
		    _("This is the program before an edit. It cannot be changed.") : _("This page is read-only"));
	return true;
}

/* The input method shows its candidates beside the cursor. */
static void place_input(LadderCanvas *canvas)
{
	graphene_rect_t rect;

	if (!state_of(canvas)->document || !gtk_widget_has_focus(GTK_WIDGET(canvas)))
		return;
	rect = canvas_rect(canvas, class_of(canvas)->cursor_box(canvas));
	gtk_im_context_set_cursor_location(own_of(canvas)->input.method, &(GdkRectangle){
		(int)rect.origin.x, (int)rect.origin.y, (int)rect.size.width,
		(int)rect.size.height });
}

void canvas_moved(LadderCanvas *canvas)
{
	place_input(canvas);
	canvas_cells_later(canvas);
	g_signal_emit(canvas, signals[CURSOR_MOVED], 0);
}

/* ---- colours ---- */

/* Cached: to look up a setting takes as long as to draw a few wires. */
const struct theme *canvas_theme(LadderCanvas *canvas)
{
	struct canvas_own *own = own_of(canvas);

	if (!own->theme)
		own->theme = theme_get(theme_kind_screen(),
			(enum theme_power)settings_enum("power", THEME_GREEN));
	return own->theme;
}

static void restyle(LadderCanvas *canvas)
{
	own_of(canvas)->theme = NULL;
	if (class_of(canvas)->restyle && state_of(canvas)->document)
		class_of(canvas)->restyle(canvas);
	gtk_widget_queue_draw(GTK_WIDGET(canvas));
}

/* ---- places ---- */

static double scroll_of(LadderCanvas *canvas, int which)
{
	return gtk_adjustment_get_value(state_of(canvas)->adjustment[which]);
}

graphene_point_t canvas_point(LadderCanvas *canvas, double x, double y)
{
	return GRAPHENE_POINT_INIT((float)((x + scroll_of(canvas, 0)) / state_of(canvas)->zoom),
				   (float)((y + scroll_of(canvas, 1)) / state_of(canvas)->zoom));
}

graphene_rect_t canvas_rect(LadderCanvas *canvas, graphene_rect_t box)
{
	graphene_rect_scale(&box, (float)state_of(canvas)->zoom, (float)state_of(canvas)->zoom, &box);
	box.origin.x -= (float)scroll_of(canvas, 0);
	box.origin.y -= (float)scroll_of(canvas, 1);
	return box;
}

graphene_rect_t canvas_page(LadderCanvas *canvas)
{
	const struct canvas_state *state = state_of(canvas);
	graphene_rect_t page;

	page.origin = canvas_point(canvas, 0, 0);
	graphene_size_init(&page.size,
		(float)(gtk_adjustment_get_page_size(state->adjustment[0]) / state->zoom),
		(float)(gtk_adjustment_get_page_size(state->adjustment[1]) / state->zoom));
	return page;
}

/* The sheet may have grown since the last allocation: the adjustment grows first. */
static void reveal_along(GtkAdjustment *adjustment, double from, double to, double upper)
{
	const double page = gtk_adjustment_get_page_size(adjustment);
	const double value = gtk_adjustment_get_value(adjustment);

	if (gtk_adjustment_get_upper(adjustment) < upper)
		gtk_adjustment_set_upper(adjustment, upper);
	if (from < value)
		gtk_adjustment_set_value(adjustment, from);
	else if (to > value + page)
		gtk_adjustment_set_value(adjustment, MIN(to - page, from));
}

void canvas_reveal(LadderCanvas *canvas, graphene_rect_t box, double aside, double above)
{
	struct canvas_own *own = own_of(canvas);
	const double zoom = state_of(canvas)->zoom;
	const double x = (double)box.origin.x * zoom, y = (double)box.origin.y * zoom;
	const double right = x + (double)box.size.width * zoom;
	const double end = y + (double)box.size.height * zoom;

	/* A page without height would scroll too far. */
	own->reveal = gtk_adjustment_get_page_size(state_of(canvas)->adjustment[1]) <= 0;
	if (own->reveal)
		return;
	reveal_along(state_of(canvas)->adjustment[0], x - aside, right + aside, right + aside);
	reveal_along(state_of(canvas)->adjustment[1], y - above, end + above, end + above);
}

/* ---- zoom ---- */

double ladder_canvas_zoom(LadderCanvas *canvas)
{
	return state_of(canvas)->zoom;
}

/* The middle of the page stays in the middle. */
static void zoom_to(LadderCanvas *canvas, double zoom)
{
	GtkAdjustment *vertical = state_of(canvas)->adjustment[1];
	const double middle = gtk_adjustment_get_page_size(vertical) / 2;
	const double at = (gtk_adjustment_get_value(vertical) + middle) / state_of(canvas)->zoom;

	zoom = CLAMP(zoom, class_of(canvas)->least_zoom, ZOOM_MOST);
	if (zoom == state_of(canvas)->zoom)
		return;
	state_of(canvas)->zoom = zoom;
	gtk_adjustment_set_upper(vertical, (double)class_of(canvas)->size(canvas).height * zoom);
	gtk_adjustment_set_value(vertical, at * zoom - middle);
	gtk_widget_queue_resize(GTK_WIDGET(canvas));
	restyle(canvas); /* images in drawings have the zoom's size */
	g_signal_emit(canvas, signals[ZOOM_CHANGED], 0);
}

void ladder_canvas_set_zoom(LadderCanvas *canvas, double zoom)
{
	const graphene_rect_t cursor = class_of(canvas)->cursor_box(canvas);
	const graphene_rect_t page = canvas_page(canvas);
	const bool seen = graphene_rect_intersection(&cursor, &page, NULL);

	zoom_to(canvas, zoom);
	if (seen)
		class_of(canvas)->reveal(canvas);
}

/* What is at (@x, @y), px of the widget, stays there. */
static void zoom_about(LadderCanvas *canvas, double zoom, double x, double y)
{
	struct canvas_anchor *anchor = &own_of(canvas)->anchor;
	const graphene_point_t at = canvas_point(canvas, x, y);

	/* Several steps before the sheet is laid out have one meaning. */
	if (!anchor->on || fabs(anchor->x - x) > 1 || fabs(anchor->y - y) > 1)
		*anchor = (struct canvas_anchor){ true, x, y, class_of(canvas)->hold ?
			class_of(canvas)->hold(canvas, at) : (struct canvas_hold){ -1, -1, at.x, at.y } };
	zoom_to(canvas, zoom);
}

static void keep_anchor(LadderCanvas *canvas)
{
	const struct canvas_anchor *anchor = &own_of(canvas)->anchor;
	const struct canvas_hold *hold = &anchor->hold;
	const double zoom = state_of(canvas)->zoom;
	const graphene_point_t at = class_of(canvas)->held ? class_of(canvas)->held(canvas, hold) :
				    GRAPHENE_POINT_INIT(hold->x, hold->y);

	gtk_adjustment_set_value(state_of(canvas)->adjustment[0], (double)at.x * zoom - anchor->x);
	gtk_adjustment_set_value(state_of(canvas)->adjustment[1], (double)at.y * zoom - anchor->y);
}

static gboolean wheel(GtkEventControllerScroll *controller, double dx, double dy,
		      LadderCanvas *canvas)
{
	GtkEventController *any = GTK_EVENT_CONTROLLER(controller);
	const GdkModifierType state = gtk_event_controller_get_current_event_state(any);
	GtkNative *native = gtk_widget_get_native(GTK_WIDGET(canvas));
	double x = 0, y = 0, left, top;

	(void)dx;
	if (!(state & GDK_CONTROL_MASK))
		return FALSE;
	/* The event has no position, and its own device none that may be asked for. */
	gdk_surface_get_device_position(gtk_native_get_surface(native), gdk_seat_get_pointer(
		gdk_display_get_default_seat(gtk_widget_get_display(GTK_WIDGET(canvas)))), &x, &y, NULL);
	gtk_native_get_surface_transform(native, &left, &top);
	gtk_widget_translate_coordinates(GTK_WIDGET(native), GTK_WIDGET(canvas), x - left, y - top, &x, &y);
	zoom_about(canvas, state_of(canvas)->zoom * (dy < 0 ? 1.1 : 1 / 1.1), x, y);
	return TRUE;
}

static void pinch_ended(GtkGesture *gesture, GdkEventSequence *sequence, LadderCanvas *canvas)
{
	(void)gesture;
	(void)sequence;
	own_of(canvas)->pinched_from = 0;
}

/* @scale: since the fingers came. */
static void pinched(GtkGestureZoom *gesture, double scale, LadderCanvas *canvas)
{
	static const double least = 0.05;
	struct canvas_own *own = own_of(canvas);
	const double now = own->state.zoom;
	double x, y, to;

	if (own->pinched_from <= 0)
		own->pinched_from = now;
	to = own->pinched_from * scale;
	if (to <= now * (1 + least) && to >= now * (1 - least))
		return;
	if (gtk_gesture_is_active(GTK_GESTURE(gesture)) &&
	    gtk_gesture_get_bounding_box_center(GTK_GESTURE(gesture), &x, &y))
		zoom_about(canvas, to, x, y);
	else
		zoom_to(canvas, to);
}

/* ---- accessible children ---- */

#define LADDER_TYPE_CANVAS_CELL (ladder_canvas_cell_get_type())
G_DECLARE_FINAL_TYPE(LadderCanvasCell, ladder_canvas_cell, LADDER, CANVAS_CELL, GtkWidget)
struct _LadderCanvasCell {
	GtkWidget parent;
};
G_DEFINE_FINAL_TYPE(LadderCanvasCell, ladder_canvas_cell, GTK_TYPE_WIDGET)

static struct canvas_cell *cell_at(LadderCanvas *canvas, guint index)
{
	return &g_array_index(own_of(canvas)->cells.cell, struct canvas_cell, index);
}

/* The actions of a cell for assistive technology. */
static void cell_go(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderCanvas *canvas = LADDER_CANVAS(gtk_widget_get_parent(widget));

	(void)unused;
	for (guint i = 0; i < own_of(canvas)->cells.cell->len; i++)
		if (cell_at(canvas, i)->widget == widget) {
			class_of(canvas)->go_to_cell(canvas, cell_at(canvas, i)->spot);
			break;
		}
	gtk_widget_grab_focus(GTK_WIDGET(canvas));
	if (g_str_has_suffix(name, ".edit"))
		ladder_canvas_do(canvas, VERB_enter);
}

static void ladder_canvas_cell_class_init(LadderCanvasCellClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_GRID_CELL);
	gtk_widget_class_install_action(widget, "cell.go", NULL, cell_go);
	gtk_widget_class_install_action(widget, "cell.edit", NULL, cell_go);
}

static void ladder_canvas_cell_init(LadderCanvasCell *cell)
{
	gtk_widget_set_can_target(GTK_WIDGET(cell), FALSE);
}

static void set_label(GtkWidget *widget, const char *name)
{
	gtk_accessible_update_property(GTK_ACCESSIBLE(widget),
				       GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
}

/* Its addresses are spelled as on the sheet. @text: taken over; may be NULL. */
static char *spelled_name(LadderCanvas *canvas, char *text)
{
	char *shown = text ? spelled_shown(state_of(canvas)->document, text) : NULL;

	g_free(text);
	return shown;
}

/* @name: taken over. */
static void cell_set_name(struct canvas_cell *cell, char *name)
{
	if (g_strcmp0(name, cell->name) != 0)
		set_label(cell->widget, name);
	g_free(cell->name);
	cell->name = name;
}

static GtkWidget *cell_widget_new(LadderCanvas *canvas)
{
	GtkWidget *widget = g_object_new(LADDER_TYPE_CANVAS_CELL, NULL);

	gtk_widget_set_parent(widget, GTK_WIDGET(canvas));
	return widget;
}

void canvas_add_cell(LadderCanvas *canvas, struct canvas_spot spot, bool current)
{
	struct canvas_cells *cells = &own_of(canvas)->cells;
	struct canvas_cell *cell;

	if (cells->listed >= cells->cell->len) {
		const struct canvas_cell fresh = { .widget = cell_widget_new(canvas) };

		g_array_append_val(cells->cell, fresh);
	}
	cell = cell_at(canvas, cells->listed++);
	cell->spot = spot;
	cell_set_name(cell, spelled_name(canvas, class_of(canvas)->cell_name(canvas, spot)));
	gtk_accessible_update_state(GTK_ACCESSIBLE(cell->widget),
				    GTK_ACCESSIBLE_STATE_SELECTED, current, -1);
}

/* The widget is hidden, not removed: no new layout. */
void canvas_set_blank(LadderCanvas *canvas, const char *name)
{
	struct canvas_cells *cells = &own_of(canvas)->cells;

	if (!cells->blank)
		cells->blank = cell_widget_new(canvas);
	if (name)
		set_label(cells->blank, name);
	gtk_accessible_update_state(GTK_ACCESSIBLE(cells->blank),
				    GTK_ACCESSIBLE_STATE_HIDDEN, !name,
				    GTK_ACCESSIBLE_STATE_SELECTED, name != NULL, -1);
}

static void drop_cells(LadderCanvas *canvas, guint from)
{
	GArray *cells = own_of(canvas)->cells.cell;

	for (guint i = from; i < cells->len; i++) {
		gtk_widget_unparent(cell_at(canvas, i)->widget);
		g_free(cell_at(canvas, i)->name);
	}
	g_array_set_size(cells, from);
}

/* Announces a new place or thing, not new values: a timer would never be silent. Not while
 * the entry is open, which is announced itself. */
static void say_cursor(LadderCanvas *canvas)
{
	struct canvas_cells *cells = &own_of(canvas)->cells;
	char *said, *text;

	if (state_of(canvas)->entry)
		return;
	said = class_of(canvas)->cursor_name(canvas, false);
	if (said && g_strcmp0(said, cells->said) != 0) {
		text = class_of(canvas)->cursor_name(canvas, true);
		spoken_say(GTK_WIDGET(canvas), text);
		g_free(text);
	}
	if (said) {
		g_free(cells->said);
		cells->said = said;
	}
}

static gboolean list_cells(gpointer data)
{
	LadderCanvas *canvas = data;
	struct canvas_cells *cells = &own_of(canvas)->cells;

	cells->timer = 0;
	cells->listed = 0;
	class_of(canvas)->list_cells(canvas);
	drop_cells(canvas, cells->listed);
	say_cursor(canvas);
	gtk_widget_queue_allocate(GTK_WIDGET(canvas));
	return G_SOURCE_REMOVE;
}

void canvas_cells_later(LadderCanvas *canvas)
{
	struct canvas_cells *cells = &own_of(canvas)->cells;

	if (!cells->timer)
		cells->timer = g_timeout_add(FOLLOW_MS, list_cells, canvas);
}

void canvas_say_again(LadderCanvas *canvas)
{
	g_clear_pointer(&own_of(canvas)->cells.said, g_free);
	canvas_cells_later(canvas);
}

void canvas_cells_rename(LadderCanvas *canvas)
{
	for (guint i = 0; i < own_of(canvas)->cells.cell->len; i++) {
		char *name = spelled_name(canvas, class_of(canvas)->cell_name(canvas, cell_at(canvas, i)->spot));

		if (name)
			cell_set_name(cell_at(canvas, i), name);
	}
}

static void allocate_at(LadderCanvas *canvas, GtkWidget *widget, graphene_rect_t box)
{
	const graphene_rect_t rect = canvas_rect(canvas, box);

	gtk_widget_measure(widget, GTK_ORIENTATION_HORIZONTAL, -1, NULL, NULL, NULL, NULL);
	gtk_widget_size_allocate(widget, &(GtkAllocation){
		(int)rect.origin.x, (int)rect.origin.y, MAX((int)rect.size.width, 1),
		MAX((int)rect.size.height, 1) }, -1);
}

static void allocate_cells(LadderCanvas *canvas)
{
	struct canvas_cells *cells = &own_of(canvas)->cells;
	graphene_rect_t box;

	for (guint i = 0; i < cells->cell->len; i++)
		if (class_of(canvas)->cell_box(canvas, cell_at(canvas, i)->spot, &box))
			allocate_at(canvas, cell_at(canvas, i)->widget, box);
	if (cells->blank)
		allocate_at(canvas, cells->blank, class_of(canvas)->cursor_box(canvas));
}

static void clear_cells(LadderCanvas *canvas)
{
	struct canvas_cells *cells = &own_of(canvas)->cells;

	g_clear_handle_id(&cells->timer, g_source_remove);
	drop_cells(canvas, 0);
	g_clear_pointer(&cells->blank, gtk_widget_unparent);
	g_clear_pointer(&cells->said, g_free);
}

/* ---- size and scrolling ---- */

static void configure(GtkAdjustment *adjustment, double content, double page)
{
	const double upper = MAX(content, page);
	const double value = CLAMP(gtk_adjustment_get_value(adjustment), 0, upper - page);

	gtk_adjustment_configure(adjustment, value, 0, upper, 40, page * 0.9, page);
}

static void lay_out(LadderCanvas *canvas, double page)
{
	if (class_of(canvas)->lay_out)
		class_of(canvas)->lay_out(canvas, page);
}

/* The entry and the context menu. */
static void present_popovers(GtkWidget *widget)
{
	GtkWidget *child = gtk_widget_get_first_child(widget);

	for (; child; child = gtk_widget_get_next_sibling(child))
		if (GTK_IS_POPOVER(child))
			gtk_popover_present(GTK_POPOVER(child));
}

static void ladder_canvas_size_allocate(GtkWidget *widget, int width, int height,
					int baseline)
{
	LadderCanvas *canvas = LADDER_CANVAS(widget);
	struct canvas_own *own = own_of(canvas);
	graphene_size_t size;

	(void)baseline;
	own->allocating = true;
	lay_out(canvas, height);
	size = class_of(canvas)->size(canvas);
	configure(state_of(canvas)->adjustment[0], (double)size.width * state_of(canvas)->zoom, width);
	configure(state_of(canvas)->adjustment[1], (double)size.height * state_of(canvas)->zoom, height);
	if (own->reveal) {
		class_of(canvas)->reveal(canvas);
		lay_out(canvas, height);
		class_of(canvas)->reveal(canvas); /* rungs above may have grown */
	}
	if (own->anchor.on) {
		keep_anchor(canvas);
		lay_out(canvas, height);
		keep_anchor(canvas);
	}
	own->anchor.on = false;
	if (height != own->cells.height)
		canvas_cells_later(canvas);
	own->cells.height = height;
	allocate_cells(canvas);
	present_popovers(widget);
	own->allocating = false;
}

static void ladder_canvas_measure(GtkWidget *widget, GtkOrientation orientation, int for_size,
				  int *least, int *natural, int *least_base,
				  int *natural_base)
{
	LadderCanvas *canvas = LADDER_CANVAS(widget);

	(void)for_size;
	*least = 100;
	*natural = orientation == GTK_ORIENTATION_HORIZONTAL ?
		MAX((int)((double)class_of(canvas)->size(canvas).width * state_of(canvas)->zoom), 100) :
		400;
	*least_base = *natural_base = -1;
}

/* Redraws at once, allocates later: allocation takes longer than drawing. */
static void scrolled(LadderCanvas *canvas)
{
	struct canvas_own *own = own_of(canvas);

	if (!state_of(canvas)->document)
		return;
	g_clear_handle_id(&own->cells.timer, g_source_remove);
	canvas_cells_later(canvas);
	if (!own->allocating) {
		own->allocating = true; /* rungs above may grow and scroll */
		lay_out(canvas, gtk_widget_get_height(GTK_WIDGET(canvas)));
		own->allocating = false;
		if (state_of(canvas)->entry)
			gtk_widget_queue_allocate(GTK_WIDGET(canvas));
	}
	if (class_of(canvas)->scrolled)
		class_of(canvas)->scrolled(canvas);
	gtk_widget_queue_draw(GTK_WIDGET(canvas));
}

static void forget_adjustment(LadderCanvas *canvas, int which)
{
	GtkAdjustment **adjustment = &state_of(canvas)->adjustment[which];

	if (*adjustment)
		g_signal_handlers_disconnect_by_data(*adjustment, canvas);
	g_clear_object(adjustment);
}

static void set_adjustment(LadderCanvas *canvas, int which, GtkAdjustment *adjustment)
{
	forget_adjustment(canvas, which);
	if (!adjustment)
		adjustment = gtk_adjustment_new(0, 0, 0, 0, 0, 0);
	g_set_object(&state_of(canvas)->adjustment[which], adjustment);
	g_signal_connect_swapped(adjustment, "value-changed", G_CALLBACK(scrolled), canvas);
	gtk_widget_queue_resize(GTK_WIDGET(canvas));
}

/* ---- drawing ---- */

static void snapshot_composed(LadderCanvas *canvas, GtkSnapshot *snapshot,
			      const struct theme *theme)
{
	const graphene_rect_t cell = canvas_rect(canvas, class_of(canvas)->cursor_box(canvas));
	PangoLayout *layout = gtk_widget_create_pango_layout(GTK_WIDGET(canvas),
							     own_of(canvas)->input.composed);
	int width, height;
	float x = cell.origin.x + COMPOSED, y = cell.origin.y + COMPOSED;

	pango_layout_get_pixel_size(layout, &width, &height);
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_SHEET],
		&GRAPHENE_RECT_INIT(x, y, (float)width + 2 * COMPOSED,
				    (float)height + 2 * COMPOSED));
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_ACCENT],
		&GRAPHENE_RECT_INIT(x, y + (float)height + 2 * COMPOSED - 2,
				    (float)width + 2 * COMPOSED, 2));
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(x + COMPOSED, y + COMPOSED));
	gtk_snapshot_append_layout(snapshot, layout, &theme->color[TOKEN_INK]);
	gtk_snapshot_restore(snapshot);
	g_object_unref(layout);
}

void canvas_snapshot_hint(LadderCanvas *canvas, GtkSnapshot *snapshot,
			  const struct theme *theme, const char *text, graphene_point_t at)
{
	PangoLayout *layout = gtk_widget_create_pango_layout(GTK_WIDGET(canvas), text);

	pango_layout_set_spacing(layout, 6 * PANGO_SCALE);
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &at);
	gtk_snapshot_append_layout(snapshot, layout, &theme->color[TOKEN_COMMENT]);
	gtk_snapshot_restore(snapshot);
	g_object_unref(layout);
}

static void ladder_canvas_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	LadderCanvas *canvas = LADDER_CANVAS(widget);
	const struct theme *theme = canvas_theme(canvas);
	const graphene_rect_t whole = GRAPHENE_RECT_INIT(0, 0,
		(float)gtk_widget_get_width(widget), (float)gtk_widget_get_height(widget));

	gtk_snapshot_push_clip(snapshot, &whole);
	gtk_snapshot_append_color(snapshot, &theme->color[TOKEN_SHEET], &whole);
	class_of(canvas)->paint(canvas, snapshot, theme);
	if (own_of(canvas)->input.composed)
		snapshot_composed(canvas, snapshot, theme);
	gtk_snapshot_pop(snapshot);
	lettering_trim(state_of(canvas)->lettering);
}

/* ---- the popup ---- */

static char *line_changed(void *data, const char *line, int cursor, bool *good)
{
	LadderCanvas *canvas = data;
	struct canvas_own *own = own_of(canvas);
	char *told;

	*good = true;
	if (!state_of(canvas)->entry)
		return NULL; /* in its constructor; ladder_entry_popup_ask() follows */
	told = own->question.changed(own->question.context, line, cursor, good);
	if (!own->refusal)
		return told;
	*good = false;
	g_free(told);
	return g_steal_pointer(&own->refusal);
}

static bool line_taken(void *data, const char *line)
{
	struct canvas_own *own = own_of(data);
	char *canonical = own->question.spells ? spelled_canonical(state_of(data)->document, line) :
			  g_strdup(line);
	bool good;

	own->taking = true;
	good = own->question.taken(own->question.context, canonical);
	g_free(canonical);
	own->taking = false;
	if (good)
		g_clear_pointer(&own->refusal, g_free);
	return good;
}

static void line_gone(void *data)
{
	canvas_close_entry(data);
	gtk_widget_grab_focus(data);
}

static void line_left(void *data, const char *line)
{
	char *text = g_strdup_printf(_("\"%s\" was not applied"), line);

	canvas_tell(data, text);
	g_free(text);
}

static void forget_question(LadderCanvas *canvas)
{
	struct canvas_question *question = &own_of(canvas)->question;

	if (question->free)
		question->free(question->context);
	*question = (struct canvas_question){ 0 };
}

void canvas_ask(LadderCanvas *canvas, const struct canvas_question *question)
{
	const struct entry_popup_calls calls = {
		.changed = line_changed, .taken = line_taken, .gone = line_gone,
		.context = canvas, .left = question->drops ? NULL : line_left,
		.proposes = question->proposes,
		.spelling = spelled_rule(state_of(canvas)->document, spelling_screen()),
	};
	char *text = question->spells ? spelled_shown(state_of(canvas)->document, question->text) :
		     g_strdup(question->text);
	const graphene_rect_t rect = canvas_rect(canvas, class_of(canvas)->cursor_box(canvas));
	GtkWidget *entry;

	if (state_of(canvas)->entry)
		canvas_close_entry(canvas);
	forget_question(canvas);
	g_clear_pointer(&own_of(canvas)->refusal, g_free);
	own_of(canvas)->question = *question;
	own_of(canvas)->question.text = NULL; /* the caller's */
	entry = ladder_entry_popup_new(GTK_WIDGET(canvas), question->prompt, text, question->typed, &calls);
	g_free(text);
	state_of(canvas)->entry = entry;
	ladder_entry_popup_ask(LADDER_ENTRY_POPUP(entry));
	ladder_entry_popup_show(LADDER_ENTRY_POPUP(entry), &(GdkRectangle){
		(int)rect.origin.x, (int)rect.origin.y, (int)rect.size.width,
		(int)rect.size.height });
}

void canvas_blame(LadderCanvas *canvas, const struct entry *entry)
{
	if (entry->sense == ENTRY_WRONG && state_of(canvas)->entry)
		ladder_entry_popup_wrong(LADDER_ENTRY_POPUP(state_of(canvas)->entry), entry->wrong,
					 entry->wrong_at, entry->wrong_len);
}

static char *say_why(void *why, const char *line, int cursor, bool *good)
{
	(void)line;
	(void)cursor;
	*good = false;
	return g_strdup(why);
}

static bool take_nothing(void *why, const char *line)
{
	(void)why;
	(void)line;
	return false;
}

void canvas_refuse(LadderCanvas *canvas, const char *prompt, const char *why)
{
	canvas_ask(canvas, &(struct canvas_question){
		.prompt = prompt, .text = "", .drops = true, .changed = say_why,
		.taken = take_nothing, .context = g_strdup(why), .free = g_free,
	});
	canvas_tell(canvas, why);
}

void canvas_close_entry(LadderCanvas *canvas)
{
	GtkWidget *entry = state_of(canvas)->entry;

	state_of(canvas)->entry = NULL;
	if (class_of(canvas)->closed)
		class_of(canvas)->closed(canvas, entry != NULL);
	if (entry)
		ladder_entry_popup_keep(LADDER_ENTRY_POPUP(entry));
}

/* ---- keys ---- */

/* Passes a key to the input method; false: the method returned it unchanged. */
static bool is_composed(LadderCanvas *canvas, GtkEventControllerKey *controller, gunichar key)
{
	struct canvas_input *input = &own_of(canvas)->input;

	input->key = key;
	input->plain = false;
	return gtk_im_context_filter_keypress(input->method,
		gtk_event_controller_get_current_event(GTK_EVENT_CONTROLLER(controller))) &&
	       !input->plain;
}

/* During composition all keys go to the input method. */
static gboolean key_captured(GtkEventControllerKey *controller, guint key, guint code,
			     GdkModifierType state, LadderCanvas *canvas)
{
	(void)code;
	(void)state;
	return own_of(canvas)->input.composed && !state_of(canvas)->entry &&
	       is_composed(canvas, controller, gdk_keyval_to_unicode(key));
}

static void show_composed(LadderCanvas *canvas)
{
	struct canvas_input *input = &own_of(canvas)->input;
	char *text = NULL;

	gtk_im_context_get_preedit_string(input->method, &text, NULL, NULL);
	g_clear_pointer(&input->composed, g_free);
	if (text && text[0])
		input->composed = g_steal_pointer(&text);
	g_free(text);
	gtk_widget_queue_draw(GTK_WIDGET(canvas));
}

/* A character without a key: Chinese, or with an accent. */
static void key_composed(GtkIMContext *method, const char *text, LadderCanvas *canvas)
{
	struct canvas_input *input = &own_of(canvas)->input;

	(void)method;
	if (text[0] && g_utf8_get_char(text) == input->key && !*g_utf8_next_char(text))
		input->plain = true;
	else if (!state_of(canvas)->entry)
		class_of(canvas)->type(canvas, text);
}

static void key_released(GtkEventControllerKey *controller, guint key, guint code,
			 GdkModifierType state, LadderCanvas *canvas)
{
	(void)key;
	(void)code;
	(void)state;
	gtk_im_context_filter_keypress(own_of(canvas)->input.method,
		gtk_event_controller_get_current_event(GTK_EVENT_CONTROLLER(controller)));
}

static gboolean key_pressed(GtkEventControllerKey *controller, guint key, guint code,
			    GdkModifierType state, LadderCanvas *canvas)
{
	const GdkModifierType others = GDK_CONTROL_MASK | GDK_ALT_MASK | GDK_SUPER_MASK;
	const gunichar letter = gdk_keyval_to_unicode(key);
	char text[8] = "";

	(void)code;
	if (class_of(canvas)->key(canvas, key, state) ||
	    is_composed(canvas, controller, letter))
		return TRUE;
	if (state & others || !g_unichar_isgraph(letter))
		return FALSE;
	text[g_unichar_to_utf8(letter, text)] = '\0';
	class_of(canvas)->type(canvas, text);
	return TRUE;
}

static void focus_changed(LadderCanvas *canvas)
{
	struct canvas_input *input = &own_of(canvas)->input;

	restyle(canvas);
	if (!state_of(canvas)->document)
		return;
	if (gtk_widget_has_focus(GTK_WIDGET(canvas))) {
		gtk_im_context_focus_in(input->method);
		place_input(canvas);
		return;
	}
	gtk_im_context_reset(input->method);
	gtk_im_context_focus_out(input->method);
	show_composed(canvas);
}

static void add_keys(LadderCanvas *canvas)
{
	GtkEventController *captured = gtk_event_controller_key_new();
	GtkEventController *keys = gtk_event_controller_key_new();
	GtkIMContext *method = gtk_im_multicontext_new();

	own_of(canvas)->input.method = method;
	gtk_im_context_set_client_widget(method, GTK_WIDGET(canvas));
	gtk_event_controller_set_propagation_phase(captured, GTK_PHASE_CAPTURE);
	g_signal_connect(captured, "key-pressed", G_CALLBACK(key_captured), canvas);
	g_signal_connect(keys, "key-pressed", G_CALLBACK(key_pressed), canvas);
	g_signal_connect(keys, "key-released", G_CALLBACK(key_released), canvas);
	g_signal_connect(method, "commit", G_CALLBACK(key_composed), canvas);
	g_signal_connect_swapped(method, "preedit-changed", G_CALLBACK(show_composed), canvas);
	g_signal_connect(canvas, "notify::has-focus", G_CALLBACK(focus_changed), NULL);
	gtk_widget_add_controller(GTK_WIDGET(canvas), captured);
	gtk_widget_add_controller(GTK_WIDGET(canvas), keys);
	/* Added last, called first: before the characters that open the entry. */
	gtk_widget_add_controller(GTK_WIDGET(canvas),
				  verbs_controller(class_of(canvas)->keys));
}

/* ---- a drag near an edge ---- */

/* px a step, more near the edge; 0: not near. */
static double edge_speed(double at, double size)
{
	const double depth = at < EDGE ? EDGE - at : at > size - EDGE ?
			     EDGE - (size - at) : 0;
	const double by = SLOWEST + (FASTEST - SLOWEST) * MIN(depth / EDGE, 1);

	return depth <= 0 || size < 4 * EDGE ? 0 : at < EDGE ? -by : by;
}

static bool scroll_by(GtkAdjustment *adjustment, double by)
{
	const double before = gtk_adjustment_get_value(adjustment);

	if (by != 0)
		gtk_adjustment_set_value(adjustment, before + by);
	return gtk_adjustment_get_value(adjustment) != before;
}

static gboolean edge_step(gpointer data)
{
	LadderCanvas *canvas = data;
	struct canvas_press *press = &own_of(canvas)->press;
	const double by_x = edge_speed(press->edge.x, gtk_widget_get_width(data));
	const double by_y = edge_speed(press->edge.y, gtk_widget_get_height(data));
	const bool moved = scroll_by(state_of(canvas)->adjustment[0], by_x);

	if (!scroll_by(state_of(canvas)->adjustment[1], by_y) && !moved) {
		press->edge.timer = 0; /* the end of the sheet */
		return G_SOURCE_REMOVE;
	}
	press->edge.again(canvas, press->edge.x, press->edge.y, press->edge.state);
	return G_SOURCE_CONTINUE;
}

void canvas_scroll_at_edge(LadderCanvas *canvas, double x, double y, GdkModifierType state,
			   void (*again)(LadderCanvas *canvas, double x, double y,
					 GdkModifierType state))
{
	struct canvas_press *press = &own_of(canvas)->press;

	press->edge.x = x;
	press->edge.y = y;
	press->edge.state = state;
	press->edge.again = again;
	if (edge_speed(x, gtk_widget_get_width(GTK_WIDGET(canvas))) == 0 &&
	    edge_speed(y, gtk_widget_get_height(GTK_WIDGET(canvas))) == 0)
		g_clear_handle_id(&press->edge.timer, g_source_remove);
	else if (!press->edge.timer)
		press->edge.timer = g_timeout_add(STEP_MS, edge_step, canvas);
}

void canvas_end_drag(LadderCanvas *canvas)
{
	struct canvas_press *press = &own_of(canvas)->press;

	press->dragging = false;
	g_clear_handle_id(&press->edge.timer, g_source_remove);
}

/* ---- the pointer ---- */

static GdkModifierType modifiers_of(gpointer gesture)
{
	return gtk_event_controller_get_current_event_state(GTK_EVENT_CONTROLLER(gesture));
}

static void pressed(GtkGestureClick *gesture, int count, double x, double y,
		    LadderCanvas *canvas)
{
	struct canvas_press *press = &own_of(canvas)->press;

	gtk_widget_grab_focus(GTK_WIDGET(canvas));
	press->x = x;
	press->y = y;
	press->dragging = false;
	class_of(canvas)->press(canvas, x, y, count, modifiers_of(gesture));
}

static void released(GtkGestureClick *gesture, int count, double x, double y,
		     LadderCanvas *canvas)
{
	const struct canvas_press *press = &own_of(canvas)->press;

	(void)gesture;
	if (class_of(canvas)->release)
		class_of(canvas)->release(canvas, x, y, count,
			gtk_drag_check_threshold(GTK_WIDGET(canvas), (int)press->x,
						 (int)press->y, (int)x, (int)y));
}

static void show_menu(GtkGestureClick *gesture, int count, double x, double y,
		      LadderCanvas *canvas)
{
	pressed(gesture, MIN(count, 1), x, y, canvas);
	popover_menu(GTK_WIDGET(canvas), class_of(canvas)->menu(canvas),
		     &(GdkRectangle){ (int)x, (int)y, 1, 1 }, GTK_WIDGET(canvas));
}

void canvas_show_menu(LadderCanvas *canvas)
{
	graphene_rect_t rect;

	class_of(canvas)->reveal(canvas);
	rect = canvas_rect(canvas, class_of(canvas)->cursor_box(canvas));
	popover_menu(GTK_WIDGET(canvas), class_of(canvas)->menu(canvas),
		     &(GdkRectangle){ (int)rect.origin.x, (int)rect.origin.y,
				      (int)(rect.size.width / 2), (int)rect.size.height },
		     GTK_WIDGET(canvas));
}

static GMenuModel *those_that_apply(LadderCanvas *canvas, const enum verb *verbs,
				    bool (*applies)(LadderCanvas *canvas, enum verb verb))
{
	GMenu *menu = g_menu_new();

	for (; *verbs != VERB_COUNT; verbs++)
		if (applies(canvas, *verbs))
			verb_append(menu, *verbs, NULL, NULL);
	return G_MENU_MODEL(menu);
}

void canvas_append_section(LadderCanvas *canvas, GMenu *menu, const enum verb *verbs,
			   bool (*applies)(LadderCanvas *canvas, enum verb verb))
{
	GMenuModel *section = those_that_apply(canvas, verbs, applies);

	g_menu_append_section(menu, NULL, section);
	g_object_unref(section);
}

void canvas_append_submenu(LadderCanvas *canvas, GMenu *menu, const char *name,
			   const enum verb *verbs,
			   bool (*applies)(LadderCanvas *canvas, enum verb verb))
{
	GMenuModel *submenu = those_that_apply(canvas, verbs, applies);

	if (g_menu_model_get_n_items(submenu) > 0)
		g_menu_append_submenu(menu, _(name), submenu);
	g_object_unref(submenu);
}

static void drag_again(LadderCanvas *canvas, double x, double y, GdkModifierType state)
{
	class_of(canvas)->drag(canvas, x, y, state);
}

static void drag_update(GtkGestureDrag *gesture, double by_x, double by_y,
			LadderCanvas *canvas)
{
	struct canvas_press *press = &own_of(canvas)->press;
	double x, y;

	if (!class_of(canvas)->can_drag(canvas) ||
	    !gtk_gesture_drag_get_start_point(gesture, &x, &y) ||
	    (!press->dragging &&
	     !gtk_drag_check_threshold(GTK_WIDGET(canvas), (int)x, (int)y, (int)(x + by_x),
				       (int)(y + by_y))))
		return;
	press->dragging = true;
	if (class_of(canvas)->drag(canvas, x + by_x, y + by_y, modifiers_of(gesture)))
		gtk_gesture_set_state(GTK_GESTURE(gesture), GTK_EVENT_SEQUENCE_CLAIMED);
	else if (!press->edge.timer)
		return;
	canvas_scroll_at_edge(canvas, x + by_x, y + by_y, modifiers_of(gesture), drag_again);
}

static void drag_end(GtkGestureDrag *gesture, double by_x, double by_y, LadderCanvas *canvas)
{
	(void)gesture;
	(void)by_x;
	(void)by_y;
	canvas_end_drag(canvas);
	class_of(canvas)->drag_end(canvas, false);
}

static void drag_cancel(GtkGesture *gesture, GdkEventSequence *sequence,
			LadderCanvas *canvas)
{
	(void)gesture;
	(void)sequence;
	canvas_end_drag(canvas);
	class_of(canvas)->drag_end(canvas, true);
}

/* A tooltip must not cover the entry or a menu. */
static bool is_covered(LadderCanvas *canvas)
{
	GtkWidget *child = gtk_widget_get_first_child(GTK_WIDGET(canvas));

	while (child && !(GTK_IS_POPOVER(child) && gtk_widget_get_mapped(child)))
		child = gtk_widget_get_next_sibling(child);
	return child;
}

static gboolean tip_wanted(GtkWidget *widget, int x, int y, gboolean by_keys,
			   GtkTooltip *tooltip)
{
	LadderCanvas *canvas = LADDER_CANVAS(widget);
	gboolean shown;
	char *text;

	if (state_of(canvas)->entry || is_covered(canvas))
		return FALSE;
	text = spelled_name(canvas, class_of(canvas)->tip(canvas, x, y, by_keys));
	shown = tip_show(tooltip, text);
	g_free(text);
	return shown;
}

static void add_pointer(LadderCanvas *canvas)
{
	GtkWidget *widget = GTK_WIDGET(canvas);
	GtkGesture *click = gtk_gesture_click_new(), *menu = gtk_gesture_click_new();
	GtkGesture *drag = gtk_gesture_drag_new(), *pinch = gtk_gesture_zoom_new();
	GtkEventController *scroll = gtk_event_controller_scroll_new(
		GTK_EVENT_CONTROLLER_SCROLL_VERTICAL);

	g_signal_connect(click, "pressed", G_CALLBACK(pressed), canvas);
	g_signal_connect(click, "released", G_CALLBACK(released), canvas);
	gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(click));
	gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(menu), GDK_BUTTON_SECONDARY);
	g_signal_connect(menu, "pressed", G_CALLBACK(show_menu), canvas);
	gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(menu));
	g_signal_connect(drag, "drag-update", G_CALLBACK(drag_update), canvas);
	g_signal_connect(drag, "drag-end", G_CALLBACK(drag_end), canvas);
	g_signal_connect(drag, "cancel", G_CALLBACK(drag_cancel), canvas);
	gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(drag));
	g_signal_connect(scroll, "scroll", G_CALLBACK(wheel), canvas);
	gtk_event_controller_set_propagation_phase(scroll, GTK_PHASE_CAPTURE);
	gtk_widget_add_controller(widget, scroll);
	g_signal_connect(pinch, "end", G_CALLBACK(pinch_ended), canvas);
	g_signal_connect(pinch, "scale-changed", G_CALLBACK(pinched), canvas);
	gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(pinch));
	gtk_widget_set_has_tooltip(widget, TRUE);
	g_signal_connect(canvas, "query-tooltip", G_CALLBACK(tip_wanted), NULL);
}

/* ---- the document ---- */

struct xref *canvas_uses(LadderCanvas *canvas)
{
	struct canvas_own *own = own_of(canvas);
	struct project *project = ladder_document_project(state_of(canvas)->document);

	if (own->xref || !project)
		return own->xref;
	own->xref = g_new0(struct xref, 1);
	if (!xref_addresses(own->xref, project)) {
		xref_free(own->xref);
		g_clear_pointer(&own->xref, g_free);
	}
	return own->xref;
}

static void forget_uses(LadderCanvas *canvas)
{
	if (own_of(canvas)->xref)
		xref_free(own_of(canvas)->xref);
	g_clear_pointer(&own_of(canvas)->xref, g_free);
}

static void project_changed(LadderCanvas *canvas)
{
	forget_uses(canvas);
	class_of(canvas)->project_changed(canvas);
}

static void rungs_changed(LadderCanvas *canvas, int pou, int at, int removed, int inserted)
{
	forget_uses(canvas);
	class_of(canvas)->rungs_changed(canvas, pou, at, removed, inserted);
}

static void variable_changed(LadderCanvas *canvas, int pou, const char *name,
			     const char *address)
{
	forget_uses(canvas);
	if (class_of(canvas)->variable_changed)
		class_of(canvas)->variable_changed(canvas, pou, name, address);
}

static void bookmarks_changed(LadderCanvas *canvas)
{
	if (class_of(canvas)->bookmarks_changed)
		class_of(canvas)->bookmarks_changed(canvas);
}

static void checked(LadderCanvas *canvas)
{
	class_of(canvas)->checked(canvas);
}

void canvas_show(LadderCanvas *canvas, LadderDocument *document, int pou)
{
	state_of(canvas)->document = g_object_ref(document);
	state_of(canvas)->pou = pou;
	lettering_spell(state_of(canvas)->lettering, spelled_rule(document, spelling_screen()));
	g_signal_connect_swapped(document, "rungs-changed", G_CALLBACK(rungs_changed), canvas);
	g_signal_connect_swapped(document, "project-changed", G_CALLBACK(project_changed),
				 canvas);
	g_signal_connect_swapped(document, "variable-changed", G_CALLBACK(variable_changed),
				 canvas);
	g_signal_connect_swapped(document, "bookmarks-changed", G_CALLBACK(bookmarks_changed),
				 canvas);
	g_signal_connect_swapped(document, "checked", G_CALLBACK(checked), canvas);
	project_changed(canvas);
	checked(canvas);
}

int ladder_canvas_pou(LadderCanvas *canvas)
{
	return state_of(canvas)->pou;
}

LadderDocument *ladder_canvas_document(LadderCanvas *canvas)
{
	return state_of(canvas)->document;
}

LadderSim *ladder_canvas_sim(LadderCanvas *canvas)
{
	return state_of(canvas)->sim;
}

void ladder_canvas_set_pou(LadderCanvas *canvas, int pou)
{
	state_of(canvas)->pou = pou;
	project_changed(canvas);
}

/* ---- the simulation ---- */

bool canvas_is_live(LadderCanvas *canvas)
{
	return state_of(canvas)->sim && ladder_sim_is_on(state_of(canvas)->sim);
}

static void values_changed(LadderCanvas *canvas)
{
	class_of(canvas)->values_changed(canvas);
}

static void program_gone(LadderCanvas *canvas)
{
	class_of(canvas)->program_gone(canvas);
}

static void program_changed(LadderCanvas *canvas)
{
	class_of(canvas)->program_changed(canvas);
}

static void state_changed(LadderCanvas *canvas)
{
	if (class_of(canvas)->state_changed)
		class_of(canvas)->state_changed(canvas);
	else
		values_changed(canvas);
}

void canvas_acts(LadderCanvas *canvas, struct location at, const char *prompt)
{
	own_of(canvas)->acted_at = at;
	own_of(canvas)->acted_as = prompt;
}

/* An entry that is open is for something else by now. */
static void refused(LadderCanvas *canvas, const struct location *at, const char *why)
{
	const char *prompt = own_of(canvas)->acted_as;

	if (!prompt || !live_value_is_same(own_of(canvas)->acted_at, *at))
		return;
	own_of(canvas)->acted_as = NULL;
	if (!state_of(canvas)->entry && gtk_widget_get_mapped(GTK_WIDGET(canvas)))
		canvas_refuse(canvas, prompt, why);
}

static void forget_sim(LadderCanvas *canvas)
{
	if (state_of(canvas)->sim)
		g_signal_handlers_disconnect_by_data(state_of(canvas)->sim, canvas);
	g_clear_object(&state_of(canvas)->sim);
}

void ladder_canvas_set_sim(LadderCanvas *canvas, LadderSim *sim)
{
	const bool was_on = canvas_is_live(canvas);

	forget_sim(canvas);
	if (sim) {
		state_of(canvas)->sim = g_object_ref(sim);
		g_signal_connect_swapped(sim, "shown", G_CALLBACK(values_changed), canvas);
		g_signal_connect_swapped(sim, "program-gone", G_CALLBACK(program_gone), canvas);
		g_signal_connect_swapped(sim, "program-changed", G_CALLBACK(program_changed),
					 canvas);
		g_signal_connect_swapped(sim, "state-changed", G_CALLBACK(state_changed),
					 canvas);
		g_signal_connect_swapped(sim, "refused", G_CALLBACK(refused), canvas);
	}
	if (was_on || canvas_is_live(canvas)) {
		program_gone(canvas);
		program_changed(canvas);
	}
}

/* ---- verbs ---- */

void ladder_canvas_do(LadderCanvas *canvas, enum verb verb)
{
	class_of(canvas)->do_verb(canvas, verb);
}

char *ladder_canvas_place(LadderCanvas *canvas)
{
	return class_of(canvas)->place(canvas);
}

char *ladder_canvas_next_keys(LadderCanvas *canvas)
{
	return class_of(canvas)->next_keys(canvas);
}

/* ---- life ---- */

static void ladder_canvas_get_property(GObject *object, guint id, GValue *value,
				       GParamSpec *spec)
{
	LadderCanvas *canvas = LADDER_CANVAS(object);

	if (id == PROP_HADJUSTMENT || id == PROP_VADJUSTMENT)
		g_value_set_object(value, state_of(canvas)->adjustment[id - PROP_HADJUSTMENT]);
	else if (id == PROP_HPOLICY || id == PROP_VPOLICY)
		g_value_set_enum(value, (int)own_of(canvas)->policy[id - PROP_HPOLICY]);
	else
		G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
}

static void ladder_canvas_set_property(GObject *object, guint id, const GValue *value,
				       GParamSpec *spec)
{
	LadderCanvas *canvas = LADDER_CANVAS(object);

	if (id == PROP_HADJUSTMENT || id == PROP_VADJUSTMENT)
		set_adjustment(canvas, (int)id - PROP_HADJUSTMENT, g_value_get_object(value));
	else if (id == PROP_HPOLICY || id == PROP_VPOLICY)
		own_of(canvas)->policy[id - PROP_HPOLICY] =
			(GtkScrollablePolicy)g_value_get_enum(value);
	else
		G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
}

static void ladder_canvas_dispose(GObject *object)
{
	LadderCanvas *canvas = LADDER_CANVAS(object);
	struct canvas_own *own = own_of(canvas);

	ladder_entry_popup_drop(GTK_WIDGET(canvas));
	canvas_end_drag(canvas);
	forget_sim(canvas);
	clear_cells(canvas);
	forget_adjustment(canvas, 0);
	forget_adjustment(canvas, 1);
	if (state_of(canvas)->document)
		g_signal_handlers_disconnect_by_data(state_of(canvas)->document, canvas);
	forget_uses(canvas);
	g_clear_object(&own->input.method);
	g_clear_object(&state_of(canvas)->document);
	G_OBJECT_CLASS(ladder_canvas_parent_class)->dispose(object);
}

static void ladder_canvas_finalize(GObject *object)
{
	LadderCanvas *canvas = LADDER_CANVAS(object);
	struct canvas_own *own = own_of(canvas);

	forget_question(canvas);
	g_array_unref(own->cells.cell);
	g_free(own->input.composed);
	g_free(own->refusal);
	g_clear_pointer(&state_of(canvas)->lettering, lettering_free);
	G_OBJECT_CLASS(ladder_canvas_parent_class)->finalize(object);
}

/* Addresses get another spelling. */
static void respell(LadderCanvas *canvas)
{
	struct canvas_state *state = state_of(canvas);

	lettering_spell(state->lettering, spelled_rule(state->document, spelling_screen()));
	class_of(canvas)->project_changed(canvas);
	gtk_widget_queue_draw(GTK_WIDGET(canvas));
	canvas_cells_later(canvas);
}

/* Not in ladder_canvas_init(): the class of the subclass is unknown there. */
static void ladder_canvas_constructed(GObject *object)
{
	LadderCanvas *canvas = LADDER_CANVAS(object);

	G_OBJECT_CLASS(ladder_canvas_parent_class)->constructed(object);
	state_of(canvas)->zoom = CLAMP(settings_number("zoom", 1.0), class_of(canvas)->least_zoom,
			     ZOOM_MOST);
	/* power flows to the right, and "%IX0.0" is read so, whatever the language */
	gtk_widget_set_direction(GTK_WIDGET(canvas), GTK_TEXT_DIR_LTR);
	state_of(canvas)->lettering = lettering_new(gtk_widget_get_pango_context(GTK_WIDGET(canvas)),
					  NULL);
	theme_follow(canvas, G_CALLBACK(restyle));
	if (settings_get()) {
		g_signal_connect_object(settings_get(), "changed::power", G_CALLBACK(restyle),
					canvas, G_CONNECT_SWAPPED);
		g_signal_connect_object(settings_get(), "changed::spelling", G_CALLBACK(respell),
					canvas, G_CONNECT_SWAPPED);
	}
	g_signal_connect(canvas, "notify::scale-factor", G_CALLBACK(restyle), NULL);
	set_label(GTK_WIDGET(canvas), _(class_of(canvas)->name));
	add_keys(canvas);
	add_pointer(canvas);
}

static void ladder_canvas_class_init(LadderCanvasClass *class)
{
	GObjectClass *object = G_OBJECT_CLASS(class);
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
	const GType type = G_TYPE_FROM_CLASS(class);

	object->get_property = ladder_canvas_get_property;
	object->set_property = ladder_canvas_set_property;
	object->constructed = ladder_canvas_constructed;
	object->dispose = ladder_canvas_dispose;
	object->finalize = ladder_canvas_finalize;
	widget->measure = ladder_canvas_measure;
	widget->size_allocate = ladder_canvas_size_allocate;
	widget->snapshot = ladder_canvas_snapshot;
	g_object_class_override_property(object, PROP_HADJUSTMENT, "hadjustment");
	g_object_class_override_property(object, PROP_VADJUSTMENT, "vadjustment");
	g_object_class_override_property(object, PROP_HPOLICY, "hscroll-policy");
	g_object_class_override_property(object, PROP_VPOLICY, "vscroll-policy");
	signals[CURSOR_MOVED] = g_signal_new("cursor-moved", type, G_SIGNAL_RUN_LAST, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	signals[TOLD] = g_signal_new("told", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
		G_TYPE_NONE, 1, G_TYPE_STRING);
	signals[ZOOM_CHANGED] = g_signal_new("zoom-changed", type, G_SIGNAL_RUN_LAST, 0,
		NULL, NULL, NULL, G_TYPE_NONE, 0);
	gtk_widget_class_set_css_name(widget, "sheet");
	gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_GRID);
}

static void ladder_canvas_init(LadderCanvas *canvas)
{
	own_of(canvas)->cells.cell = g_array_new(FALSE, TRUE, sizeof(struct canvas_cell));
	set_adjustment(canvas, 0, NULL);
	set_adjustment(canvas, 1, NULL);
	gtk_widget_set_focusable(GTK_WIDGET(canvas), TRUE);
	gtk_widget_set_overflow(GTK_WIDGET(canvas), GTK_OVERFLOW_HIDDEN);
}
