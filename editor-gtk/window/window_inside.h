/* SPDX-License-Identifier: MIT
 *
 * window_inside - what the files of the window share. Only editor-gtk/window*.c include it.
 */
#ifndef EDITOR_WINDOW_INSIDE_H
#define EDITOR_WINDOW_INSIDE_H

#include "editor-gtk/sim/board_run.h"
#include "editor-gtk/document/classic_origin.h"
#include "editor-gtk/text/file_view.h"
#include "editor-gtk/ladder/grid_view_live.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/scenario_record.h"
#include "editor-gtk/sfc/sfc_view.h"
#include "editor-gtk/sim/sim.h"
#include "editor-gtk/text/text_view.h"
#include "editor-gtk/window/window.h"

struct _LadderWindow {
	AdwApplicationWindow parent;
	LadderDocument *document;
	LadderBoardRun *board;    /* what runs on this machine                 */
	bool board_ran;           /* it came to a scan                         */
	char *board_said;         /* its state that the log has; NULL: none    */
	bool close_after_board;   /* the person said so                        */
	char *origin;             /* of a sample: the file it is a copy of     */
	LadderOrigin *classic;    /* what it was taken from; NULL: nothing     */
	char *plant;              /* that a person chose; NULL: none           */
	bool plant_chosen;
	struct window_why *why;   /* what holds power back                     */
	struct window_older *older; /* the program before an edit              */
	LadderSim *sim;           /* off while it edits                        */
	LadderRecorder *recorder;
	int pou_count;            /* when the tabs were updated                */
	bool closing;             /* the person has been asked                 */
	guint disk_timer;         /* until the file is looked at again         */
	enum disk_state disk_told; /* what was told of it                      */
	bool over_locked;         /* its file is read-only, and written over all the same */
	guint when_timer;         /* until the title tells the simulated time  */
	void (*banner_do)(LadderWindow *window);
	/* Template widgets */
	AdwToastOverlay *toasts;
	AdwWindowTitle *title;
	GtkButton *undo_button, *redo_button;
	GtkMenuButton *menu_button;
	GtkPaned *side_paned, *side, *right_paned, *below_paned;
	GtkBox *right;            /* of the simulation                         */
	GtkToggleButton *edit_mode, *simulate_mode;
	GtkBox *sim_buttons;
	GtkButton *run_button, *forces_button, *record_button;
	GtkMenuButton *pace_button;
	GtkWidget *tree, *palette;
	AdwTabBar *tab_bar;
	GtkWidget *front;            /* the tabs, and what is said without any   */
	AdwTabView *tabs;
	GtkLabel *nothing_label;
	GtkRevealer *banner;
	GtkLabel *banner_label;
	GtkButton *banner_button, *banner_close;
	GtkBox *find_place, *below;
	GtkStack *below_stack;
	GtkWidget *below_switcher;
	GtkScrolledWindow *below_tabs;
	GtkMenuButton *below_more;   /* seen when the tabs are not all            */
	gint64 told_at;       /* us; when the message in the status bar came    */
	guint64 told_of;      /* version of the document then                   */
	char *keys_text;      /* what stands there otherwise                   */
	GtkLabel *pill, *place_label, *message_label, *checked_label, *zoom_label;
};

/* ---- window.c ---- */
/** window_toast - a message that goes by itself. */
void window_toast(LadderWindow *window, const char *text);
/** window_log - a line of the log (ladder_log_view_put). */
void window_log(LadderWindow *window, const char *kind, const char *text);
/** window_banner - a message that stays until it is closed; @act on the button @button;
 * NULL: none. The log keeps it, as one of the system. */
void window_banner(LadderWindow *window, const char *text, const char *button,
		   void (*act)(LadderWindow *window));
/** window_banner_of - the same; the log keeps it as one of @kind, translated. */
void window_banner_of(LadderWindow *window, const char *kind, const char *text,
		      const char *button, void (*act)(LadderWindow *window));
void window_banner_close(LadderWindow *window);
/** window_show_keys - what the next key could do (taken over), where no message stands. */
void window_show_keys(LadderWindow *window, char *text);
/** window_show_state - title, undo, redo, status. */
void window_show_state(LadderWindow *window);

/* ---- window_below.c: the panels below the sheets ---- */
void below_init(LadderWindow *window);
/** below_panel - by the name of its tab; made now, if nobody has seen it yet. Borrowed. */
GtkWidget *below_panel(LadderWindow *window, const char *name);
/** below_made - the same; NULL: nobody has seen it yet. */
GtkWidget *below_made(LadderWindow *window, const char *name);
/** below_show - the same, brought to the front. */
GtkWidget *below_show(LadderWindow *window, const char *name);
/** below_offer - whether it has a tab to be seen by. */
void below_offer(LadderWindow *window, const char *name, bool offered);

/* ---- window_place.c: the status bar ---- */
/** tabs_show_place - in the status bar: of the cursor that is seen. */
void tabs_show_place(LadderWindow *window);
/** place_follow - what is told of the text of a page goes with its cursor. */
void place_follow(LadderWindow *window, AdwTabPage *page);
/** tabs_list - the text of a program in front; NULL: there is none. */
LadderTextView *tabs_list(LadderWindow *window);

/** tabs_text - what the text in front holds, of a program, of the file, of one beside the
 * project; NULL: there is none. Borrowed. */
GtkTextBuffer *tabs_text(LadderWindow *window);
/** tabs_reveal_cursor - that of the text in front is seen, and the text has the keys. */
void tabs_reveal_cursor(LadderWindow *window);

/* ---- window_step.c ---- */
/** window_step - of the history: undoes one, or does it again, and shows what it changed. */
void window_step(LadderWindow *window, bool redo);

/* ---- window_number.c ---- */
/** window_ask_number - of a rung or a line of what is in front, and goes there. */
void window_ask_number(LadderWindow *window);

/* ---- window_tabs.c ---- */
void tabs_init(LadderWindow *window);
/** tabs_update - those there should be: POUs may have come and gone. */
void tabs_update(LadderWindow *window);
/** tabs_show - brings a POU to the front, and opens it if need be. */
void tabs_show(LadderWindow *window, int pou);
/** tabs_show_widget - a page that is no POU, by the name it was made with. */
GtkWidget *tabs_show_widget(LadderWindow *window, const char *name);
/** tabs_show_file - a text file beside the project. */
void tabs_show_file(LadderWindow *window, const char *path);
/** tabs_take_typed - what was just typed into a text or a cell is in the document now; false:
 * it was refused, which is told where it stands, and once. */
bool tabs_take_typed(LadderWindow *window);
/** tabs_content - what a page shows, inside of scrolling. */
GtkWidget *tabs_content(AdwTabPage *page);
/** tabs_init_closing - a page that is closed asks for what is not saved in it. */
void tabs_init_closing(LadderWindow *window);
/** tabs_close - the page in front; what is not saved in it is asked for first. */
void tabs_close(LadderWindow *window);
/** tabs_put_file - opens a page for a side file that is not open yet: a draft. */
void tabs_put_file(LadderWindow *window, LadderSideFile *file);
/** tabs_find_file - of that path; NULL: it is not open. */
LadderFileView *tabs_find_file(LadderWindow *window, const char *path);
/** tabs_file - of the page in front; NULL: it is none. */
LadderFileView *tabs_file(LadderWindow *window);
/** tabs_each_file - calls @act with each open LadderSideFile. */
void tabs_each_file(LadderWindow *window, void (*act)(gpointer file));
/** tabs_unsaved - the files beside the project that are not saved, of LadderSideFile *.
 * Caller: g_ptr_array_unref. */
GPtrArray *tabs_unsaved(LadderWindow *window);
/** tabs_page_new - a sheet, a chart or a list: POU @pou of @document, that tells the
 * window. It scrolls. */
GtkWidget *tabs_page_new(LadderWindow *window, LadderDocument *document, int pou);
/** tabs_seen_sheet, tabs_seen_chart - as tabs_sheet(), tabs_chart(), but also of a program
 * before an edit, whose document is not the window's. */
LadderGridView *tabs_seen_sheet(LadderWindow *window);
LadderSfcView *tabs_seen_chart(LadderWindow *window);
/** tabs_sheet - of the page in front; NULL: it is none. */
LadderGridView *tabs_sheet(LadderWindow *window);
/** tabs_chart - of the page in front; NULL: it is none. */
LadderSfcView *tabs_chart(LadderWindow *window);
/** tabs_enter_program - the sheet, the chart or the text that is seen has the keys; false: none
 * is in front. */
bool tabs_enter_program(LadderWindow *window);
/** tabs_enter - the same of any page, unless something in it has them. */
void tabs_enter(LadderWindow *window);
/** tabs_go - the place of a diagnostic or a use; -1: the whole. */
void tabs_go(LadderWindow *window, int pou, int rung, int row, int col);

/* ---- window_older.c: a program before an edit, in the place of the tabs ---- */
void window_older_init(LadderWindow *window);
void window_older_free(LadderWindow *window);
/** window_older_page - what is seen of it; NULL: the program that runs is seen. */
GtkWidget *window_older_page(LadderWindow *window);
/** window_older_by - so many of its POUs further. False: it is not seen. */
bool window_older_by(LadderWindow *window, int by);

/* ---- window_actions.c ---- */
void window_install_actions(GtkWidgetClass *class);
/** window_menu - the main menu, of the rows of verbs.def. Caller: g_object_unref. */
GMenu *window_menu(void);

/* ---- window_names.c: of the name at the cursor ---- */
void names_go_driver(LadderWindow *window);
/** names_at_cursor - of the element there; NULL: there is none, and that is told. Caller
 * frees. */
char *names_at_cursor(LadderWindow *window);
/** names_watch - it comes into the status chart, which is shown. */
void names_watch(LadderWindow *window);
void names_watch_this(LadderWindow *window, const char *name);
void names_show_uses(LadderWindow *window);
/** names_follow - the cursor went on: a cross reference that has nothing is asked anew. */
void names_follow(LadderWindow *window);
/** names_uses_seen - the cross reference came to sight: it is asked for the name at the
 * cursor, if there is one. */
void names_uses_seen(GtkWidget *uses, LadderWindow *window);
void names_show_uses_of(LadderWindow *window, const char *name);
/** names_begin - @xref is made, @here the first use at the cursor; false: there is none,
 * which is told. The caller frees @xref, which was zero, either way. */
bool names_begin(LadderWindow *window, struct xref *xref, int *here);
/** names_is_here - is that use at the cursor, as @here is? */
bool names_is_here(LadderWindow *window, const struct xref *xref, int here, int use);

/* ---- window_rename.c: another name ---- */
/** names_rename - of what is at the cursor; the person is asked. */
void names_rename(LadderWindow *window);
/** names_rename_pou - the same of a program or block. */
void names_rename_pou(LadderWindow *window, int pou);

/* ---- window_file.c ---- */
/** window_chooser - a file chooser for rung files over @window; shown by the caller. Owns:
 * the caller, g_object_unref when it was answered. */
GtkFileChooserNative *window_chooser(LadderWindow *window, const char *title,
				     GtkFileChooserAction action, const char *accept);
/** window_chosen_path - of a file chooser; NULL: no file of this machine. Caller frees. */
char *window_chosen_path(GtkNativeDialog *dialog);
void window_open(LadderWindow *window);
void window_save(LadderWindow *window);
void window_save_as(LadderWindow *window);
/** window_save_here - where its file lies; false: it is asked first, or cannot be, which is
 * told. */
bool window_save_here(LadderWindow *window);
/** window_ask_save - shall @name be saved? The answer is the response "save", "discard" or
 * "cancel" of the dialog that it returns; borrowed. */
GtkWidget *window_ask_save(LadderWindow *window, const char *name);
/** window_save_file - of a tab; false: it could not be, and that is told. */
bool window_save_file(LadderWindow *window, LadderSideFile *file);
/** window_may_close - false: the person is asked first, and the window closes itself. */
bool window_may_close(LadderWindow *window);
/** window_watch_disk - tells if somebody else changes the file. */
void window_watch_disk(LadderWindow *window);

/* ---- window_write.c ---- */
typedef void window_write(LadderWindow *window, const char *path);
/** window_save_named - @save(@window, @path), which gets the first of @endings (".csv|.txt")
 * if it has none of them; the person is asked if a file of that name is there, of which the
 * dialog did not know. */
void window_save_named(LadderWindow *window, const char *path, const char *endings,
		       window_write *save);
/** window_ask_where - asks for a file beside the program, named as it, and writes it.
 * @endings: as for window_save_named; lives for ever. Returns the dialog; it owns itself. */
GtkFileChooser *window_ask_where(LadderWindow *window, const char *title,
				 const char *endings, window_write *save);
/** window_name_with - of the document or what it was taken from, with another ending.
 * Caller frees. */
char *window_name_with(LadderWindow *window, const char *ending);
/** window_export_symbols - asks for a file: all symbols as a table. */
void window_export_symbols(LadderWindow *window);

/* ---- window_classic.c ---- */
/** window_report_new - the panel; it is offered when there is a report. */
GtkWidget *window_report_new(LadderWindow *window);
void window_show_report(LadderWindow *window);
/** window_show_original - of the rung at the cursor; from then on it follows. */
void window_show_original(LadderWindow *window);
void window_follow_original(LadderWindow *window);
/** window_classic_saved - the document has a file now: the I/O map of what it was taken from
 * comes to stand beside it, if nothing stands there. */
void window_classic_saved(LadderWindow *window);
void window_export_classic(LadderWindow *window);
/** window_export_to - the document stays as it is, also unsaved. False: that is told. */
bool window_export_to(LadderWindow *window, const char *path);
/** window_classic_filter - one more; @numbers: bare rung files, too, and it is the first. */
void window_classic_filter(GtkFileChooser *chooser, bool numbers);

/* ---- window_drop.c ---- */
void window_drop_init(LadderWindow *window);
/** window_drop_files - of GFile. */
void window_drop_files(LadderWindow *window, const GSList *files);

/* ---- window_find.c ---- */
void window_find_init(LadderWindow *window);
/** window_find - find, replace, next, previous. */
void window_find(LadderWindow *window, enum verb verb);
/** window_find_close - false: it is not open. */
bool window_find_close(LadderWindow *window);

/* ---- window_sim.c ---- */
void window_sim_init(LadderWindow *window);
/** window_show_pill - what the window is doing: edits, simulates, runs on this machine. */
void window_show_pill(LadderWindow *window);
/** window_sim - the verbs of the simulation; false: it is none of them. */
bool window_sim(LadderWindow *window, enum verb verb);

/* ---- window_scenario.c ---- */
/** window_scenario_init - makes the recorder. */
void window_scenario_init(LadderWindow *window);
/** window_scenario_new - the panel of scenarios. */
GtkWidget *window_scenario_new(LadderWindow *window);
/** window_scenario - the verbs of scenarios; false: it is none of them. */
bool window_scenario(LadderWindow *window, enum verb verb);
/** window_expect - while it records: that variable is to have the value it has. */
void window_expect(LadderWindow *window, const char *name);

/* ---- window_board.c ---- */
/** window_new_iomap - asks for a file, and opens it: a point for all that is used. */
void window_new_iomap(LadderWindow *window);
void window_board_init(LadderWindow *window);
/** window_board_new - the panel of what runs on this machine. */
GtkWidget *window_board_new(LadderWindow *window);
/** window_run_board - with the map in front, or the one chosen below; asks before pins are
 * driven or files are written. */
void window_run_board(LadderWindow *window);
void window_stop_board(LadderWindow *window);
/** window_board_look - a banner that no map lies beside the program goes when one does. */
void window_board_look(LadderWindow *window);
/** window_board_may_close - false: something runs; the person is asked, and the window
 * closes itself when outputs are safe. */
bool window_board_may_close(LadderWindow *window);
/** window_board_pill - of the status bar, translated, while something runs on this machine;
 * NULL: nothing does. */
const char *window_board_pill(LadderWindow *window, const char **class);

/* ---- window_plant.c ---- */
/** window_plant_ready - the simulation has its plant, as the file is now; false: it has
 * errors, @error says which. */
bool window_plant_ready(LadderWindow *window, GError **error);
void window_plant_choose(LadderWindow *window);
void window_plant_none(LadderWindow *window);

/** window_plant_of - "tank.plant.rung" of "tank.rung", if it is there. Caller frees. */
char *window_plant_of(const char *path);

/* ---- window_sample.c ---- */
/** window_sample - the file that an unsaved project is a copy of; NULL: it is none. Borrowed. */
const char *window_sample(LadderWindow *window);
/** window_sample_saved - the copy of @sample has a file now: what belongs to that comes to
 * stand beside it, where nothing stands there. That is told. */
void window_sample_saved(LadderWindow *window, const char *sample);

/* ---- window_why.c ---- */
void window_why_init(LadderWindow *window);
void window_why_free(LadderWindow *window);
/** window_why_ask - of the element at the cursor; asked again of the same: no more. */
void window_why_ask(LadderWindow *window);

/* ---- window_paper.c ---- */
void window_print(LadderWindow *window);
void window_export_pdf(LadderWindow *window);

#endif
