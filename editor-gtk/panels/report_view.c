/* SPDX-License-Identifier: MIT
 *
 * report_view - the report of an import or export; see report_view.h.
 */
#include "editor-gtk/panels/report_view.h"

#include "editor-gtk/document/classic_origin.h"
#include "editor-gtk/document/panel.h"
#include "editor-gtk/document/report_lines.h"
#include "editor-gtk/draw/grid_classic.h"
#include "editor-gtk/draw/original_draw.h"
#include "editor-gtk/kit/gtk48/paned.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/picture_view.h"
#include "editor-gtk/kit/settings.h"

/* ---- the view ---- */

struct _LadderReportView {
	GtkWidget parent_instance;
	GtkWidget *paned, *title, *picture_place;
	GtkWidget *picture;        /* a rung of ClassicLadder above the rung it became */
	struct panel_list list;
	struct panel_watch *watch;
	LadderDocument *document;
	LadderOrigin *origin;      /* of the import; NULL: none                 */
	GPtrArray *lines;          /* of the export that is shown; NULL: the import is shown */
	char *name;                /* name of the exported file                 */
	char *said;
	const struct classic_rung *shown; /* of @origin                         */
	const struct drawing *drawn;      /* the same of another tool           */
	int drawn_pou, drawn_number;      /* what it became                     */
	bool filling, shared;
};

G_DEFINE_FINAL_TYPE(LadderReportView, ladder_report_view, GTK_TYPE_WIDGET)

static guint close_wanted;

/* ---- the picture ---- */

static void put_nothing(struct picture *picture, struct lettering *lettering)
{
	const char *text = _("There is no original of this place.");
	const struct lettered fits = lettering_fit(lettering, LETTER_COMMENT, text, -1, 0);

	picture_text(picture, TOKEN_COMMENT, LETTER_COMMENT, fits, 16, 24);
	picture->width = fits.width + 32;
	picture->height = 40;
}

static void put_pair(LadderReportView *view, struct picture *picture,
		     struct lettering *lettering)
{
	const struct classic_rung *rung = view->shown;
	const char *member = rung->place.member;
	char *name = *member ? g_strdup(member) :
		g_path_get_basename(ladder_origin_path(view->origin));
	struct classic_pair pair = {
		.there = { ladder_origin_project(view->origin), rung, lettering,
			   theme_screen() },
		.there_name = name,
		.project = ladder_document_project(view->document),
		.show = (enum drafting_show)settings_enum("show", SHOW_BOTH),
		.lost = _("This rung was deleted after the import."),
	};
	GArray *ours = ladder_origin_became(view->origin, rung, &pair.pou);

	pair.rung = (const int *)(const void *)ours->data;
	pair.rungs = pair.project ? (int)ours->len : 0;
	grid_classic_pair(&pair, 0, picture);
	g_array_unref(ours);
	g_free(name);
}

static void put_drawn(LadderReportView *view, struct picture *picture, struct lettering *lettering)
{
	char *file = g_path_get_basename(ladder_origin_path(view->origin));
	/* A project of OpenPLC Editor has a file for each POU. */
	const char *name = g_str_has_suffix(file, ".xml") ? file : view->drawn->pou;
	const struct original_scene scene = {
		.drawing = view->drawn, .lettering = lettering, .theme = theme_screen(), .name = name,
		.project = ladder_document_project(view->document),
		.pou = view->drawn_pou, .number = view->drawn_number,
		.show = (enum drafting_show)settings_enum("show", SHOW_BOTH),
	};

	original_pair(&scene, picture);
	g_free(file);
}

static void draw(gpointer data, struct picture *picture, struct lettering *lettering)
{
	LadderReportView *view = data;

	if (view->shown && view->origin)
		put_pair(view, picture, lettering);
	else if (view->drawn && view->origin)
		put_drawn(view, picture, lettering);
	else
		put_nothing(picture, lettering);
}

/* ---- its lines ---- */

static char *name_picture(LadderReportView *view, const struct classic_rung *rung)
{
	if (rung)
		return g_strdup_printf(_("Original of the rung: %s"), *rung->comment ? rung->comment : rung->place.member);
	if (view->drawn)
		return g_strdup_printf(_("Original in line %d"), view->drawn->line);
	return g_strdup(_("There is no original of this place."));
}

static void show_picture(LadderReportView *view, const struct classic_rung *rung)
{
	char *text = name_picture(view, rung);

	view->shown = rung;
	spoken_name(view->picture, text);
	ladder_picture_view_again(LADDER_PICTURE_VIEW(view->picture));
	gtk_widget_set_visible(view->picture, TRUE);
	g_free(text);
}

static void refresh(GtkWidget *widget)
{
	LadderReportView *view = LADDER_REPORT_VIEW(widget);
	GPtrArray *rows;
	char *name;

	if (!ladder_report_view_has(view))
		return;
	name = view->lines ? g_strdup(view->name) :
	       g_path_get_basename(ladder_origin_path(view->origin));
	rows = view->lines ? report_lines_export(view->lines, view->document) :
	       report_lines_import(view->origin, view->document);
	view->filling = true;
	panel_list_update(&view->list, rows);
	view->filling = false;
	g_free(view->said);
	view->said = report_lines_title(name, rows);
	gtk_label_set_text(GTK_LABEL(view->title), view->said);
	tip_set(view->title, view->said);
	gtk_widget_set_visible(view->picture_place, view->origin != NULL);
	if (view->origin)
		show_picture(view, view->shown);
	g_ptr_array_unref(rows);
	g_free(name);
}

void ladder_report_view_import(LadderReportView *view, LadderOrigin *origin)
{
	if (g_set_object(&view->origin, origin)) {
		view->shown = NULL;
		view->drawn = NULL;
	}
	g_clear_pointer(&view->lines, g_ptr_array_unref);
	refresh(GTK_WIDGET(view));
}

void ladder_report_view_export(LadderReportView *view, const char *name, GPtrArray *lines)
{
	g_ptr_array_ref(lines);
	g_clear_pointer(&view->lines, g_ptr_array_unref);
	view->lines = lines;
	g_free(view->name);
	view->name = g_strdup(name);
	refresh(GTK_WIDGET(view));
}

bool ladder_report_view_has(LadderReportView *view)
{
	return view->origin || view->lines;
}

const char *ladder_report_view_title(LadderReportView *view)
{
	return view->said;
}

void ladder_report_view_focus(LadderReportView *view)
{
	gtk_widget_grab_focus(GTK_WIDGET(view->list.view));
}

void ladder_report_view_follow(LadderReportView *view, int pou, int rung)
{
	const struct classic_rung *from = view->origin ?
		ladder_origin_of(view->origin, pou, rung) : NULL;
	const struct drawing *drawn = view->origin ? ladder_origin_drawing(view->origin, pou, rung) : NULL;
	const bool other = from != view->shown || drawn != view->drawn || pou != view->drawn_pou ||
			   rung != view->drawn_number;

	view->drawn = drawn;
	view->drawn_pou = pou;
	view->drawn_number = rung;
	if (view->origin && other)
		show_picture(view, from);
	gtk_widget_set_visible(view->picture, from || rung >= 0);
}

/* ---- its rows ---- */

/* The rung of a line in the origin; NULL: none. */
static const struct classic_rung *rung_of(LadderReportView *view, const LadderPanelRow *row)
{
	const struct report_line *line;

	if (!row || view->lines || !view->origin)
		return NULL;
	line = &ladder_origin_report(view->origin)->line[row->flags];
	return ladder_origin_at(view->origin, line->member, line->line);
}

static void selected(LadderReportView *view)
{
	const struct classic_rung *rung = rung_of(view, panel_list_row(&view->list));

	if (!view->filling && rung)
		show_picture(view, rung);
}

static void activated(GtkColumnView *list, guint at, LadderReportView *view)
{
	LadderPanelRow *row = g_list_model_get_item(G_LIST_MODEL(view->list.selection), at);

	(void)list;
	if (row && row->pou >= 0)
		panel_go_to(GTK_WIDGET(view), row);
	g_clear_object(&row);
}

/* ---- texts of several lines, and behind each where it stood ---- */

static void setup_text(GtkSignalListItemFactory *factory, GtkListItem *item)
{
	GtkWidget *label = gtk_label_new(NULL);

	(void)factory;
	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_wrap(GTK_LABEL(label), TRUE);
	gtk_list_item_set_child(item, label);
}

static void bind_text(GtkSignalListItemFactory *factory, GtkListItem *item)
{
	LadderPanelRow *row = gtk_list_item_get_item(item);
	GtkWidget *label = gtk_list_item_get_child(item);
	char *markup;

	(void)factory;
	markup = g_markup_printf_escaped("%s  <span alpha=\"70%%\" size=\"small\">%s</span>",
					 panel_row_text(row, REPORT_TEXT),
					 panel_row_text(row, REPORT_THERE));
	gtk_label_set_markup(GTK_LABEL(label), markup);
	g_free(markup);
	panel_speak(label, row);
}

static GtkListItemFactory *text_factory(void)
{
	GtkListItemFactory *factory = gtk_signal_list_item_factory_new();

	g_signal_connect(factory, "setup", G_CALLBACK(setup_text), NULL);
	g_signal_connect(factory, "bind", G_CALLBACK(bind_text), NULL);
	return factory;
}

/* ---- the widget ---- */

#define LIST_MOST 620 /* initial width of the list in px, at most; the picture gets the rest */

static gboolean share_now(gpointer data)
{
	LadderReportView *view = data;

	if (view->paned)
		gtk_paned_set_position(GTK_PANED(view->paned), MIN(
			gtk_widget_get_width(view->paned) / 2, LIST_MOST));
	g_object_unref(view);
	return G_SOURCE_REMOVE;
}

/* Once; then the divider stays where a person moves it. The signal comes during layout: a
 * position that is set then leaves GTK with a widget without allocation, and a blank window. */
static void share_room(GtkPaned *paned, GParamSpec *spec, LadderReportView *view)
{
	(void)spec;
	if (gtk_widget_get_width(GTK_WIDGET(paned)) < 2 || view->shared)
		return;
	view->shared = true;
	g_idle_add(share_now, g_object_ref(view));
}

static void copy(GtkWidget *widget, const char *name, GVariant *unused)
{
	LadderReportView *view = LADDER_REPORT_VIEW(widget);
	char *text = report_lines_text(view->said ? view->said : "",
				       G_LIST_MODEL(view->list.selection));

	(void)name;
	(void)unused;
	gdk_clipboard_set_text(gtk_widget_get_clipboard(widget), text);
	g_free(text);
}

static void close_this(GtkWidget *widget, const char *name, GVariant *unused)
{
	(void)name;
	(void)unused;
	g_signal_emit(widget, close_wanted, 0);
}

static void dispose(GObject *object)
{
	LadderReportView *view = LADDER_REPORT_VIEW(object);

	g_clear_pointer(&view->watch, panel_watch_free);
	g_clear_pointer(&view->paned, gtk_widget_unparent);
	panel_list_clear(&view->list);
	g_clear_object(&view->document);
	g_clear_object(&view->origin);
	g_clear_pointer(&view->lines, g_ptr_array_unref);
	g_clear_pointer(&view->name, g_free);
	g_clear_pointer(&view->said, g_free);
	G_OBJECT_CLASS(ladder_report_view_parent_class)->dispose(object);
}

static void ladder_report_view_class_init(LadderReportViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	close_wanted = g_signal_new("close-wanted", LADDER_TYPE_REPORT_VIEW,
		G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(widget,
		"/org/rungboard/Editor/ui/report_view.ui");
	gtk_widget_class_bind_template_child(widget, LadderReportView, paned);
	gtk_widget_class_bind_template_child(widget, LadderReportView, title);
	gtk_widget_class_bind_template_child(widget, LadderReportView, picture_place);
	panel_bind_list(widget, LadderReportView);
	gtk_widget_class_bind_template_callback(widget, activated);
	gtk_widget_class_bind_template_callback(widget, share_room);
	gtk_widget_class_install_action(widget, "report.copy", NULL, copy);
	gtk_widget_class_install_action(widget, "report.close", NULL, close_this);
	gtk_widget_class_add_binding_action(widget, GDK_KEY_c, GDK_CONTROL_MASK,
					    "report.copy", NULL);
}

static void ladder_report_view_init(LadderReportView *view)
{
	GtkWidget *widget = GTK_WIDGET(view);

	gtk_widget_init_template(widget);
	paned_mend(GTK_PANED(view->paned));
	panel_list_init(&view->list, view->list.view);
	panel_list_column(&view->list, "", REPORT_KIND, PANEL_ICON, 0);
	panel_list_column(&view->list, _("What"), REPORT_KIND, 0, 76);
	panel_list_add(&view->list, _("Message"), REPORT_TEXT, PANEL_EXPAND, 0, text_factory());
	panel_list_column(&view->list, _("Here"), REPORT_HERE, PANEL_NUMBER, 104);
	panel_list_follow(&view->list, G_CALLBACK(selected), view);
	view->picture = ladder_picture_view_new(draw, view);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(view->picture_place),
				      view->picture);
	view->watch = panel_watch_new(widget, false, refresh);
}

GtkWidget *ladder_report_view_new(LadderDocument *document)
{
	LadderReportView *view = g_object_new(LADDER_TYPE_REPORT_VIEW, NULL);

	view->document = g_object_ref(document);
	panel_watch_set(view->watch, document);
	return GTK_WIDGET(view);
}
