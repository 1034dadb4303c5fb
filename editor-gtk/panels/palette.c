/* SPDX-License-Identifier: MIT
 *
 * palette - the palette of elements and blocks; see palette.h.
 */
#include "editor-gtk/panels/palette.h"

#include "editor-gtk/draw/ghost.h"
#include "editor-gtk/draw/grid_draw.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/ladder/grid_view.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/gtk48/tip.h"

#include <adwaita.h>
#include <string.h>

#define LADDER_TYPE_PALETTE (ladder_palette_get_type())
G_DECLARE_FINAL_TYPE(LadderPalette, ladder_palette, LADDER, PALETTE, GtkBox)

/* How well a word fits the search text: equal, begins with it, its explanation contains it. */
enum rank { RANK_IS, RANK_BEGINS, RANK_TOLD, RANK_NONE };

struct _LadderPalette {
	GtkBox parent;
	LadderDocument *document;
	GtkWidget *search, *families;
	int own;                    /* number of words of the project shown    */
	enum word best;             /* best match of the search                */
	enum rank rank;             /* how well it fits                        */
};

G_DEFINE_FINAL_TYPE(LadderPalette, ladder_palette, GTK_TYPE_BOX)

#define ICON_WIDTH  56
#define ICON_HEIGHT 34

/* ---- the icon of a tile: drawn, so that it follows the theme ---- */

#define LADDER_TYPE_ICON (ladder_icon_get_type())
G_DECLARE_FINAL_TYPE(LadderIcon, ladder_icon, LADDER, ICON, GtkWidget)

struct _LadderIcon {
	GtkWidget parent;
	const struct word_row *row; /* of the catalogue, or of the project while it is shown */
	struct lettering *lettering;
};

G_DEFINE_FINAL_TYPE(LadderIcon, ladder_icon, GTK_TYPE_WIDGET)

static const struct theme *icon_theme(void)
{
	AdwStyleManager *manager = adw_style_manager_get_default();
	const bool dark = adw_style_manager_get_dark(manager);

	if (adw_style_manager_get_high_contrast(manager))
		return theme_get(dark ? THEME_CONTRAST_DARK : THEME_CONTRAST, THEME_GREEN);
	return theme_get(dark ? THEME_DARK : THEME_LIGHT, THEME_GREEN);
}

static void ladder_icon_snapshot(GtkWidget *widget, GtkSnapshot *snapshot)
{
	LadderIcon *icon = LADDER_ICON(widget);
	const struct theme *theme = icon_theme();
	struct picture picture;

	picture_init(&picture);
	grid_draw_icon(icon->row, theme, icon->lettering,
		       (float)gtk_widget_get_width(widget),
		       (float)gtk_widget_get_height(widget), &picture);
	picture_snapshot(&picture, theme, icon->lettering, snapshot);
	picture_clear(&picture);
}

static void ladder_icon_finalize(GObject *object)
{
	lettering_free(LADDER_ICON(object)->lettering);
	G_OBJECT_CLASS(ladder_icon_parent_class)->finalize(object);
}

static void ladder_icon_class_init(LadderIconClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_icon_finalize;
	GTK_WIDGET_CLASS(class)->snapshot = ladder_icon_snapshot;
}

static void ladder_icon_init(LadderIcon *icon)
{
	icon->lettering = lettering_new(
		gtk_widget_get_pango_context(GTK_WIDGET(icon)), NULL);
	gtk_widget_set_size_request(GTK_WIDGET(icon), ICON_WIDTH, ICON_HEIGHT);
	gtk_widget_set_halign(GTK_WIDGET(icon), GTK_ALIGN_CENTER);
	g_signal_connect_object(adw_style_manager_get_default(), "notify::dark",
				G_CALLBACK(gtk_widget_queue_draw), icon,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(adw_style_manager_get_default(), "notify::high-contrast",
				G_CALLBACK(gtk_widget_queue_draw), icon,
				G_CONNECT_SWAPPED);
}

/* ---- tiles ---- */

/* The key that enters this word; NULL: none. */
static char *key_of(enum word word)
{
	static const struct { enum word word; enum verb verb; } keys[] = {
		{ ELEM_CONTACT_NO, VERB_contact }, { ELEM_CONTACT_NC, VERB_contact_not },
		{ ELEM_COIL, VERB_coil },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(keys); i++)
		if (keys[i].word == word)
			return verb_keys_label(keys[i].verb);
	return NULL;
}

static GdkContentProvider *drag_prepare(GtkDragSource *source, double x, double y,
					gpointer word)
{
	(void)source;
	(void)x;
	(void)y;
	return ladder_grid_view_drag((enum word)GPOINTER_TO_INT(word));
}

static void drag_begin(GtkDragSource *source, GdkDrag *unused, LadderIcon *icon)
{
	(void)unused;
	ghost_element(source, icon->row, icon_theme(), icon->lettering);
}

static void clicked(GtkButton *button, gpointer word)
{
	gtk_widget_activate_action(GTK_WIDGET(button), "win.place", "i",
				   GPOINTER_TO_INT(word));
}

static GtkWidget *tile_new(const struct word_row *row, enum word word)
{
	GtkWidget *button = gtk_button_new(), *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	LadderIcon *icon = g_object_new(LADDER_TYPE_ICON, NULL);
	GtkDragSource *drag = gtk_drag_source_new();
	const char *name = row->word[0] ? row->word : row->id;
	char *key = key_of(word), *tip;
	GtkWidget *label = gtk_label_new(key ? key : name);

	icon->row = row;
	gtk_widget_add_css_class(button, "flat");
	gtk_widget_add_css_class(button, "tile");
	gtk_widget_add_css_class(label, "tile-key");
	gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
	gtk_label_set_max_width_chars(GTK_LABEL(label), 8);
	gtk_box_append(GTK_BOX(box), GTK_WIDGET(icon));
	gtk_box_append(GTK_BOX(box), label);
	gtk_button_set_child(GTK_BUTTON(button), box);
	tip = g_strdup_printf("%s: %s%s%s", name, said(words_explain(row)),
			      key ? " · " : "", key ? key : "");
	tip_set(button, tip);
	spoken_name(button, tip);
	gtk_widget_set_focus_on_click(button, FALSE);
	g_signal_connect(button, "clicked", G_CALLBACK(clicked), GINT_TO_POINTER(word));
	gtk_drag_source_set_actions(drag, GDK_ACTION_COPY);
	g_signal_connect(drag, "prepare", G_CALLBACK(drag_prepare), GINT_TO_POINTER(word));
	g_signal_connect(drag, "drag-begin", G_CALLBACK(drag_begin), icon);
	gtk_widget_add_controller(button, GTK_EVENT_CONTROLLER(drag));
	g_free(tip);
	g_free(key);
	return button;
}

/* ---- families ---- */

static bool fits(const struct word_row *row, const char *search)
{
	char *all, *fold, *want;
	bool found;

	if (!search[0])
		return true;
	all = g_strdup_printf("%s %s %s %s %s %s", row->word, row->id, row->family,
			      words_explain(row), said(row->family), said(words_explain(row)));
	fold = g_utf8_casefold(all, -1);
	want = g_utf8_casefold(search, -1);
	found = strstr(fold, want);
	g_free(all);
	g_free(fold);
	g_free(want);
	return found;
}

static bool is_offered(const struct word_row *row)
{
	return row->family && row->family[0] && row->place != PLACE_NONE &&
	       row->place != PLACE_PIN && row->kind != WORD_STRUCT;
}

/* Tiles are made when their family is opened: they are most of the window's widgets. */
static void make_tiles(GtkExpander *expander)
{
	GArray *words = g_object_get_data(G_OBJECT(expander), "words");
	LadderPalette *palette = LADDER_PALETTE(gtk_widget_get_ancestor(
		GTK_WIDGET(expander), LADDER_TYPE_PALETTE));
	const struct project *project = ladder_document_project(palette->document);

	if (!gtk_expander_get_expanded(expander))
		return;
	for (guint i = 0; i < words->len; i++) {
		const enum word word = g_array_index(words, enum word, i);
		const struct word_row *row = word_is_own(word) ?
			words_row(&project->words, word) : word_row(word);
		GtkWidget *child = gtk_flow_box_child_new();

		gtk_flow_box_child_set_child(GTK_FLOW_BOX_CHILD(child),
					     tile_new(row, word));
		gtk_widget_set_focusable(child, FALSE);
		spoken_name(child, row->word[0] ? row->word : row->id);
		gtk_flow_box_append(GTK_FLOW_BOX(gtk_expander_get_child(expander)), child);
	}
	g_array_set_size(words, 0);
}

static GtkWidget *family_new(const char *name)
{
	GtkWidget *expander = gtk_expander_new(name);
	GtkWidget *flow = gtk_flow_box_new();

	gtk_flow_box_set_selection_mode(GTK_FLOW_BOX(flow), GTK_SELECTION_NONE);
	gtk_flow_box_set_min_children_per_line(GTK_FLOW_BOX(flow), 2);
	gtk_flow_box_set_max_children_per_line(GTK_FLOW_BOX(flow), 8);
	gtk_flow_box_set_homogeneous(GTK_FLOW_BOX(flow), TRUE);
	gtk_expander_set_child(GTK_EXPANDER(expander), flow);
	g_object_set_data_full(G_OBJECT(expander), "words",
			       g_array_new(FALSE, FALSE, sizeof(enum word)),
			       (GDestroyNotify)g_array_unref);
	g_signal_connect(expander, "notify::expanded", G_CALLBACK(make_tiles), NULL);
	gtk_widget_add_css_class(expander, "family");
	spoken_name(expander, name);
	spoken_name(flow, name);
	return expander;
}

/* Families that are open at first. */
static bool is_common(const char *family)
{
	static const char *const common[] = { "Contacts", "Coils", "Timers", "Counters" };

	for (gsize i = 0; i < G_N_ELEMENTS(common); i++)
		if (strcmp(family, common[i]) == 0)
			return true;
	return false;
}

static enum rank rank_of(const struct word_row *row, const char *search)
{
	const gsize len = strlen(search);
	const char *word = row->word[0] ? row->word : row->id;

	if (g_ascii_strncasecmp(word, search, len) != 0)
		return RANK_TOLD;
	return word[len] ? RANK_BEGINS : RANK_IS;
}

static void add_word(LadderPalette *palette, GHashTable *families,
		     const struct word_row *row, enum word word)
{
	const enum rank fit = rank_of(row, gtk_editable_get_text(GTK_EDITABLE(palette->search)));
	GtkWidget *family = g_hash_table_lookup(families, row->family);
	GArray *words;

	if (!family) {
		family = family_new(_(row->family));
		gtk_box_append(GTK_BOX(palette->families), family);
		g_hash_table_insert(families, (gpointer)row->family, family);
	}
	words = g_object_get_data(G_OBJECT(family), "words");
	g_array_append_val(words, word);
	if (fit < palette->rank) {
		palette->rank = fit;
		palette->best = word;
	}
}

static void open_families(GHashTable *families, bool all)
{
	GHashTableIter each;
	gpointer name, family;

	g_hash_table_iter_init(&each, families);
	while (g_hash_table_iter_next(&each, &name, &family))
		if (all || is_common(name))
			gtk_expander_set_expanded(family, TRUE);
}

static void fill(LadderPalette *palette)
{
	const char *search = gtk_editable_get_text(GTK_EDITABLE(palette->search));
	const struct project *project = ladder_document_project(palette->document);
	GHashTable *families = g_hash_table_new(g_str_hash, g_str_equal);
	GtkWidget *family;

	palette->rank = RANK_NONE;
	while ((family = gtk_widget_get_first_child(palette->families)))
		gtk_box_remove(GTK_BOX(palette->families), family);
	for (int i = 0; i < WORD_COUNT; i++) {
		const struct word_row *row = word_row((enum word)i);

		if (is_offered(row) && fits(row, search))
			add_word(palette, families, row, (enum word)i);
	}
	for (int i = 0; project && i < project->words.count; i++) {
		const enum word word = (enum word)(WORD_FIRST_OWN + i);
		const struct word_row *row = words_row(&project->words, word);

		if (is_offered(row) && fits(row, search))
			add_word(palette, families, row, word);
	}
	open_families(families, search[0]);
	palette->own = project ? project->words.count : 0;
	g_hash_table_unref(families);
}

static void leave(LadderPalette *palette)
{
	gtk_editable_set_text(GTK_EDITABLE(palette->search), "");
	gtk_widget_activate_action(GTK_WIDGET(palette), "win.to-sheet", NULL);
}

/* Uses the text in the entry: "search-changed" comes with a delay. */
static void place_best(LadderPalette *palette)
{
	enum word best;

	if (!gtk_editable_get_text(GTK_EDITABLE(palette->search))[0])
		return;
	fill(palette);
	if (palette->rank == RANK_NONE)
		return;
	best = palette->best; /* placing changes palette->best               */
	gtk_editable_set_text(GTK_EDITABLE(palette->search), "");
	gtk_widget_activate_action(GTK_WIDGET(palette), "win.place", "i", (int)best);
}

/* Rows of words of the project are freed with it. */
static void project_changed(LadderPalette *palette)
{
	const struct project *project = ladder_document_project(palette->document);

	if (palette->own > 0 || (project && project->words.count > 0))
		fill(palette);
}

static void ladder_palette_finalize(GObject *object)
{
	g_object_unref(LADDER_PALETTE(object)->document);
	G_OBJECT_CLASS(ladder_palette_parent_class)->finalize(object);
}

static void ladder_palette_class_init(LadderPaletteClass *class)
{
	G_OBJECT_CLASS(class)->finalize = ladder_palette_finalize;
}

static void ladder_palette_init(LadderPalette *palette)
{
	GtkWidget *scroller = gtk_scrolled_window_new();

	gtk_orientable_set_orientation(GTK_ORIENTABLE(palette), GTK_ORIENTATION_VERTICAL);
	palette->search = gtk_search_entry_new();
	palette->families = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2);
	gtk_widget_set_margin_start(palette->search, 10);
	gtk_widget_set_margin_end(palette->search, 10);
	gtk_widget_set_margin_top(palette->search, 6);
	gtk_search_entry_set_key_capture_widget(GTK_SEARCH_ENTRY(palette->search), NULL);
	g_object_set(palette->search, "placeholder-text", _("Find an element"), NULL);
	spoken_name(palette->search, _("Find an element"));
	spoken_name(scroller, _("Elements"));
	gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER,
				       GTK_POLICY_AUTOMATIC);
	gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scroller), palette->families);
	gtk_widget_set_vexpand(scroller, TRUE);
	gtk_box_append(GTK_BOX(palette), palette->search);
	gtk_box_append(GTK_BOX(palette), scroller);
	g_signal_connect_swapped(palette->search, "search-changed", G_CALLBACK(fill),
				 palette);
	g_signal_connect_swapped(palette->search, "activate", G_CALLBACK(place_best),
				 palette);
	g_signal_connect_swapped(palette->search, "stop-search", G_CALLBACK(leave),
				 palette);
}

void ladder_palette_find(GtkWidget *palette)
{
	gtk_widget_grab_focus(LADDER_PALETTE(palette)->search);
}

GtkWidget *ladder_palette_new(LadderDocument *document)
{
	LadderPalette *palette = g_object_new(LADDER_TYPE_PALETTE, NULL);

	palette->document = g_object_ref(document);
	g_signal_connect_object(document, "project-changed", G_CALLBACK(project_changed),
				palette, G_CONNECT_SWAPPED);
	fill(palette);
	return GTK_WIDGET(palette);
}
