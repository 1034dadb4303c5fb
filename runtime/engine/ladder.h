/* SPDX-License-Identifier: MIT
 *
 * ladder - the facade of libladder.a: from a file to a program that can run.
 *
 * Programs use this and the headers of model/, scan/, base/, show/, compare/, xref/ and
 * trial/. It prints nothing and never exits.
 */
#ifndef ENGINE_LADDER_H
#define ENGINE_LADDER_H

#include "engine/base/diag.h"
#include "engine/base/version.h"
#include "engine/exchange/classic/classic.h"
#include "engine/model/project.h"
#include "engine/scan/resource.h"

struct ladder;
struct init_value;
struct xref_target;

/** ladder_new - nothing loaded. Owns: the caller, ladder_free(). NULL: no memory. */
struct ladder *ladder_new(void);
/** ladder_new_terse - the same without suggestions in messages and without warnings
 * about the states of charts (LD450 … LD455). For boards: that code is not linked
 * (model/advice.h). */
struct ladder *ladder_new_terse(void);
void ladder_free(struct ladder *ladder);

/* The lines of an import's report: engine/exchange/report.h. */
struct classic_report;
struct drawing; /* engine/exchange/drawing.h */
struct drawings;
struct classic_lines;
/**
 * ladder_take_classic - makes later loads accept projects of ClassicLadder, too
 * @faithful: faults of the original are repeated
 *
 * A load converts them: ladder_project() and ladder_write() give the resulting rung
 * file. A program that does not call this does not link the import.
 * Fails: false: no memory.
 */
bool ladder_take_classic(struct ladder *ladder, bool faithful);
/** ladder_is_classic - whether @path is such a project, a file or a folder. */
bool ladder_is_classic(const char *path);
/** ladder_import_format - the tool whose project @path is: "ClassicLadder", or one of exchange/import.h.
 * NULL: none of them. Lives for ever. */
const char *ladder_import_format(const char *path);
/** ladder_classic_task - whether converted projects get a TASK with their period, for
 * text that is saved as a file. Off at first. */
void ladder_classic_task(struct ladder *ladder, bool task);
/** ladder_import_language - reports of later loads are in the language of @translate,
 * which gets each text, or printf format, in English. */
void ladder_import_language(struct ladder *ladder, const char *(*translate)(const char *text));
/** ladder_take_others - makes later loads accept the formats of exchange/import.h (LDmicro, OpenPLC Editor 4,
 * PLCopen XML), too, as ladder_take_classic() does. */
bool ladder_take_others(struct ladder *ladder);
/**
 * ladder_export_plcopen - the project as PLCopen XML (exchange/plcopen/plcopen_write.h)
 *
 * Owns: the caller, free(). Scan-safe: no. Fails: NULL: no project, or no memory.
 */
char *ladder_export_plcopen(struct ladder *ladder, size_t *len, struct classic_report *report);
/** ladder_import_report - the report of the last load; NULL: it was no such project.
 * Valid until the next load. */
const struct classic_report *ladder_import_report(const struct ladder *ladder);
/** ladder_import_io - the I/O map of such a project; NULL: it has none. Valid until the
 * next load. */
const char *ladder_import_io(const struct ladder *ladder);
/** ladder_import_text - the text that the last load made of such a project, also with errors in it;
 * NULL: none. Valid until the next load. */
const char *ladder_import_text(const struct ladder *ladder, size_t *len);
/** ladder_import_line - the line in the imported project that line @line of the result
 * comes from; 0: none. For a rung file @line itself. @ladder is a struct ladder. */
int ladder_import_line(const void *ladder, int line);
/** ladder_import_places - changes the places of messages in the same way. */
void ladder_import_places(const struct ladder *ladder, struct diag_list *diags);
/** ladder_import_project - the imported project as in its files; NULL: it was none.
 * Valid until the next load. */
const struct classic_project *ladder_import_project(const struct ladder *ladder);
/** ladder_import_rung - the imported rung that rung @rung (0-based) of POU @pou comes
 * from; several may come from one. NULL: none. Valid until the next load. */
const struct classic_rung *ladder_import_rung(const struct ladder *ladder, int pou,
					      int rung);
/** ladder_import_drawing - how rung or network @number (0-based) of POU @pou is drawn in the imported file;
 * NULL: it is not, or stands nowhere. Valid until the next load. */
const struct drawing *ladder_import_drawing(struct ladder *ladder, int pou, int number);
/** ladder_period - the scan period of an imported project, ns; 0: none is given. */
int64_t ladder_period(const struct ladder *ladder);

/* Files that a project names (INCLUDE, USES), from elsewhere than the disk. */
struct ladder_files {
	/* The text of a file, malloc'ed; NULL: it is not there. @path: its name, behind the
	 * folder of the file that names it. */
	char *(*load)(void *context, const char *path, size_t *len);
	void *context;
	bool or_disk;                /* a file that load() does not have is on the disk */
	void (*free)(void *context); /* with the ladder, or when others are set; NULL: borrowed */
};
/** ladder_set_files - for later loads. @files: copied; NULL, as at first: the disk. */
void ladder_set_files(struct ladder *ladder, const struct ladder_files *files);
/** ladder_files - the present ones, borrowed. */
struct ladder_files ladder_files(const struct ladder *ladder);

/**
 * ladder_load - reads a rung file, plain IEC text or a code image
 * @path: its first bytes, not its name, decide which it is. Must stay valid.
 *
 * On failure nothing is loaded; see ladder_diags(). Scan-safe: no.
 */
bool ladder_load(struct ladder *ladder, const char *path);
/**
 * ladder_load_files - reads several files of plain IEC text as one project
 * @paths: @count. One alone is read as ladder_load() does and must stay valid. 0: the folder
 *         @paths[0] has none, which is an error
 *
 * Their order means nothing. The rest is as of ladder_load().
 */
bool ladder_load_files(struct ladder *ladder, const char *const *paths, int count);
/**
 * ladder_load_stored - reads the files of one project as a board stores them
 * @names: @count, 1 or more, as of ladder_set_files(), which has them all. They are files of plain IEC
 *         text, or the first is a rung file that names the others. The first must stay valid.
 *
 * The rest is as of ladder_load().
 */
bool ladder_load_stored(struct ladder *ladder, const char *const *names, int count);
/** ladder_load_text - the same from memory; @file names it in diagnostics. */
bool ladder_load_text(struct ladder *ladder, const char *file, const void *text,
		      size_t len);
/** ladder_could_read - false after a load that could not read the file at all
 * (exit status 2 of the command line). */
bool ladder_could_read(const struct ladder *ladder);

/** ladder_leave_expressions - whether later loads leave the constant expressions of declarations
 * as they are: a part of a program names constants of the rest. Nothing can be built then. Off
 * at first. */
void ladder_leave_expressions(struct ladder *ladder, bool leave);

/** ladder_watch - whether later builds make the instrumented section, too, so that the
 * power of every cell can be read. Off at first. */
void ladder_watch(struct ladder *ladder, bool watch);

/** ladder_watch_lists - whether the instrumented section of later builds also keeps the current
 * result after each line of the lists that ladders and charts become: code_listed(), and has a
 * place before each statement of Structured Text: trial/stops.h. Such an image is larger and slower; it is for a simulation, never for a board. Off at first. */
void ladder_watch_lists(struct ladder *ladder, bool lists);

/**
 * ladder_build - checks the loaded project and translates it to a code image
 *
 * Adds all errors and warnings of check/ and translate/. On success ladder_program()
 * gives the program. A loaded image is verified already.
 */
bool ladder_build(struct ladder *ladder);

/* All of these are valid until the next load or ladder_free(). */
struct diag_list *ladder_diags(struct ladder *ladder);
struct project *ladder_project(struct ladder *ladder); /* NULL: an image    */
const struct program *ladder_program(const struct ladder *ladder); /* NULL  */
const void *ladder_image(const struct ladder *ladder, size_t *len);
/** ladder_il - the instruction list of POU @pou (translated, or as written); NULL before
 * ladder_build. */
const struct il *ladder_il(const struct ladder *ladder, int pou);
/** ladder_temporaries - variables that the translation added to POU @pou. */
struct var *const *ladder_temporaries(const struct ladder *ladder, int pou,
				      int *count);
/** ladder_memory - bytes used by project, translation and image. */
size_t ladder_memory(const struct ladder *ladder);

/* A word that may stand at a place. */
struct ladder_word {
	const char *kind;    /* "variable", "operator"                        */
	const char *text;
	const char *note;    /* its type or explanation; ""                   */
};
struct ladder_place {
	size_t prefix_len;   /* bytes of the word before the cursor           */
	int words;
};

/**
 * ladder_complete - the words that may stand before the cursor, in no order
 * @text: of the file that was loaded last; it may have errors
 * @line, @column: 1-based, bytes; the cursor is before it
 * @take: gets every word that begins with the prefix; NULL: none
 *
 * Owns: nothing; a word is valid until @take returns. Scan-safe: no.
 * Fails: false if there is no such place, an image was loaded, or memory is out.
 */
bool ladder_complete(struct ladder *ladder, const char *text, size_t len, int line,
		     int column,
		     void (*take)(void *context, const struct ladder_word *word),
		     void *context, struct ladder_place *place);

/** ladder_call_at - the call of Structured Text whose arguments are written at the cursor, as
 * ladder_complete finds it: "Wait(IN : BOOL, PT : TIME, Q => BOOL)"
 * @from, @to: get the bytes of the argument at the cursor; equal: none
 * Owns: the caller, free(). Scan-safe: no. Fails: NULL: there is none. */
char *ladder_call_at(struct ladder *ladder, const char *text, size_t len, int line, int column,
		     size_t *from, size_t *to);

/**
 * ladder_functions - the functions that an expression may call, in no order
 * @begun: the prefix of the name. Words made by rule, such as INT_TO_REAL, are given if
 *         the prefix has their first type
 * @take:  @word: its row; NULL: made by rule
 *
 * Owns: nothing; a word is valid until @take returns. Scan-safe: no.
 */
void ladder_functions(struct project *project, const char *begun, size_t len,
		      void (*take)(void *context, const struct ladder_word *word,
				   const struct word_row *row),
		      void *context);

/**
 * ladder_write - the canonical text of the project: plain IEC text if it is one such file, else a
 * rung file
 * @len: gets its length without the closing NUL
 * Owns: the caller, free().   Fails: NULL when memory is out.
 */
char *ladder_write(struct ladder *ladder, size_t *len);
/** ladder_write_source - the canonical text of one file of the project, in its own form; @number: of
 * project.source. Owns and fails as ladder_write. */
char *ladder_write_source(struct ladder *ladder, int number, size_t *len);
/**
 * ladder_export_ladder - the project with its charts converted to ladders
 * @diags: gets LD460 for parts that cannot be converted
 *
 * The text is not canonical. It declares new names, which stay in the table of names.
 * Owns: the caller, free(). Scan-safe: no.
 * Fails: NULL after a diagnostic, or when nothing was loaded.
 */
char *ladder_export_ladder(struct ladder *ladder, size_t *len, struct diag_list *diags);
/**
 * ladder_export_as - the project with POUs in another language (convert/convert.h)
 * @wanted: a byte a POU: 1 for one that is converted
 * @to:     LANGUAGE_ST: ladders, networks and charts; LANGUAGE_FBD: ladders and charts; LANGUAGE_LD: networks and
 *          charts. A chart becomes ladders first, in programs and subroutines of their own
 * @diags:  gets LD780 to LD786 for parts that cannot be converted
 *
 * The project is built. The text is not canonical. Owns: the caller, free(). Scan-safe: no.
 * Fails: NULL after a diagnostic, or when nothing was loaded.
 */
char *ladder_export_as(struct ladder *ladder, const uint8_t *wanted, enum pou_language to, size_t *len,
		       struct diag_list *diags);
/**
 * ladder_export_lists - the project with the lists that run, in canonical form
 * @wanted: a byte a POU; NULL: all of them, with those of files that the project names
 *
 * The project is built; its POUs are lists afterwards, and it can only be freed. Lists of charts cannot be
 * read again. Owns: the caller, free(). Scan-safe: no. Fails: NULL: no memory.
 */
char *ladder_export_lists(struct ladder *ladder, const uint8_t *wanted, size_t *len);
/** ladder_sfc_fits_classic - whether each chart can be a sequential page of
 * ClassicLadder. If not, use ladder_export_ladder() first. Scan-safe: no. */
bool ladder_sfc_fits_classic(struct ladder *ladder);
/**
 * ladder_export_classic - the project as one of ClassicLadder's
 * (exchange/classic/to_classic.h)
 * @dialect: of ClassicLadder, of LinuxCNC, or a bare rung file
 * @lines:   of its I/O map (exchange/classic/to_classic.h); NULL: none
 * @report: gets the changes of meaning
 * @diags: gets LD730 to LD739 for parts that cannot be exported
 *
 * Owns: the caller, free(). Scan-safe: no. Fails: NULL after a diagnostic, or when
 * nothing was loaded.
 */
char *ladder_export_classic(struct ladder *ladder, enum classic_dialect dialect,
			    const struct classic_lines *lines, size_t *len,
			    struct classic_report *report, struct diag_list *diags);
/**
 * ladder_outline - the text of ladder_write, and the places of its parts
 * @take: gets each part at its end, so inner ones before outer ones; or NULL
 *
 * Owns: the caller, free(). Scan-safe: no. Fails: NULL: no memory.
 */
char *ladder_outline(struct ladder *ladder, size_t *len,
		     void (*take)(void *context, const struct text_span *span),
		     void *context);
/** ladder_read_rung - one rung from its text: `RUNG` and its rows
 * @diags: gets its errors, with places in @text
 *
 * Its strings are ids of the project that was loaded last. Owns: the caller,
 * rung_free(). Scan-safe: no. Fails: NULL; only strings were added. */
struct rung *ladder_read_rung(struct ladder *ladder, const char *text, size_t len,
			      struct diag_list *diags);
/** ladder_take_boxes - after rungs of a POU were replaced: what text_take_boxes() does. Fails:
 * false: no memory. */
bool ladder_take_boxes(struct ladder *ladder, int pou);
/**
 * ladder_read_var - adds one declaration, `Motor AT %QX0.1 : BOOL;`, at the end of a
 * block
 * @pou: its number, not of a FUNCTION or FUNCTION_BLOCK; -1: a global variable
 * @block: of its table of variables; vars_pop() removes it again
 * @diags: gets its errors, with places in @text
 *
 * Scan-safe: no. Fails: false; only strings were added.
 */
bool ladder_read_var(struct ladder *ladder, int pou, int block, const char *text,
		     size_t len, struct diag_list *diags);
/**
 * ladder_constant - the value of a constant, or of a constant expression such as Limit - 1
 * @table: 0: as if it stood in a declaration of a global, n + 1: of POU n; behind them the
 *         structures
 * @out: type and capacity are given; gets value and literal, and the constant as text
 *
 * Owns: the text belongs to @ladder. Scan-safe: no.
 * Fails: false after a diagnostic.
 */
bool ladder_constant(struct ladder *ladder, int table, const char *text, size_t len,
		     struct init_value *out, struct diag_list *diags);
/** ladder_write_rung - its canonical text. Owns: the caller, free(). NULL: no memory. */
char *ladder_write_rung(struct ladder *ladder, const struct rung *rung);

/** ladder_name_fault - the error of this name: DIAG_EXPECTED (not a name),
 * DIAG_RESERVED_NAME; or a warning: DIAG_SHADOWS_ADDRESS; DIAG_COUNT: it is valid. */
enum diag_id ladder_name_fault(const char *name);

/* Why a rename is refused. */
enum ladder_refusal {
	RENAME_GOOD,
	RENAME_NOTHING,  /* the target has no name of its own                 */
	RENAME_FORM,     /* the new name is not a name                        */
	RENAME_RESERVED, /* the new name is reserved                          */
	RENAME_TAKEN,    /* another variable, POU … has it in this scope      */
	RENAME_MEANING,  /* at this place the name would mean something else  */
	RENAME_OTHER_FILE, /* it is used here, in another file                */
	RENAME_MEMORY,
};
struct ladder_rename {
	enum ladder_refusal why;
	int pou;             /* place of the conflict; -1: the globals, or none */
	int rung, row, col;  /* 1-based, as in struct xref_use; 0: none       */
	int places;          /* places that change, with the declaration      */
};
/**
 * ladder_rename - renames a variable, wire, member, label, POU, type or value and all its uses
 * @target: from xref/xref.h, of the unchanged project
 * @how: gets the number of places, or the reason and place of a refusal
 *
 * Every name in the result means the same as before. The result variable of a FUNCTION
 * is renamed with it. Comments, titles and other files do not change. The project
 * itself does not change.
 * Owns: the caller, free(): the canonical text with the new name. Scan-safe: no.
 * Fails: NULL and the reason.
 */
char *ladder_rename(struct ladder *ladder, const struct xref_target *target,
		    const char *name, size_t *len, struct ladder_rename *how);

/* ---- for the files of the facade itself ---- */

/** ladder_read_project - the project of the last load, also with errors; NULL: none, or
 * an image. Valid until the next load. */
struct project *ladder_read_project(struct ladder *ladder);

/* A reader of another tool's files: it converts them to the text of a rung file. */
struct foreign {
	bool (*is)(const void *bytes, size_t len);
	bool (*is_folder)(const char *path);
	/* The text and its name for diagnostics, both valid until the next call; NULL
	 * after a diagnostic. @bytes NULL: @path is a folder. */
	const char *(*read)(struct foreign *foreign, const char *path, const void *bytes,
			    size_t len, size_t *text_len, const char **name,
			    struct diag_list *diags);
	/* Changes places in that text to places in the file. */
	void (*place)(struct foreign *foreign, struct diag_list *diags);
	void (*forget)(struct foreign *foreign); /* frees the results of the last read */
	void (*free)(struct foreign *foreign);
	/* The line of the file that a line of the text comes from; 0: none. */
	int (*line)(const struct foreign *foreign, int line);
	struct classic_report *report; /* of the last read                    */
	const struct drawings *drawings; /* NULL: it makes none              */
	const char *text; /* that the last load read, @text_len bytes         */
	size_t text_len;
	bool task;        /* gets a CONFIGURATION with the period, for a file that is saved */
	int64_t period_ns; /* of the last read; 0: none is given              */
	bool classic;     /* names of ClassicLadder are known where values are typed */
	bool loaded;      /* the last load used it                            */
	struct foreign *next;
};
/** ladder_add_foreign - one more reader for later loads; the last one is asked first.
 * Owns: @ladder. */
void ladder_add_foreign(struct ladder *ladder, struct foreign *foreign);
/** ladder_foreign - the first reader; the others follow it. NULL: none. */
struct foreign *ladder_foreign(const struct ladder *ladder);
#endif
