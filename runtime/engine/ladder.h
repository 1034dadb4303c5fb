/* SPDX-License-Identifier: MIT
 *
 * ladder - the facade of libladder.a: from a file to something that runs.
 *
 * Programs include this, model/, scan/ and base/ headers and nothing else of the
 * engine but show/, compare/, xref/ and trial/. It prints nothing and exits never.
 */
#ifndef ENGINE_LADDER_H
#define ENGINE_LADDER_H

#include "engine/base/diag.h"
#include "engine/base/version.h"
#include "engine/model/outline.h"
#include "engine/exchange/classic/classic.h"
#include "engine/model/project.h"
#include "engine/scan/resource.h"

struct ladder;
struct xref_target;

/** ladder_new - nothing loaded. Owns: the caller, ladder_free(). NULL: no memory. */
struct ladder *ladder_new(void);
/** ladder_new_terse - the same, but messages suggest no names, and there are no warnings
 * about states of charts (LD450 … LD455). All errors and other warnings stay. For boards:
 * the code that this saves is not linked (model/advice.h). */
struct ladder *ladder_new_terse(void);
void ladder_free(struct ladder *ladder);

/* What an import took, changed and left out: engine/exchange/report.h. */
struct classic_report;
struct classic_lines;
/**
 * ladder_take_classic - loads take projects of ClassicLadder, too, from now on
 * @faithful: faults of the original are repeated
 *
 * They are converted as they are loaded: ladder_project() and ladder_write() have the rung
 * file that they become. A program that does not call this does not link the import.
 * Fails: false: no memory.
 */
bool ladder_take_classic(struct ladder *ladder, bool faithful);
/** ladder_is_classic - is there such a project, a file or a folder, at @path? */
bool ladder_is_classic(const char *path);
/** ladder_classic_task - shall what they become have a TASK with their period? Off at
 * first: it is for text that is to be a file of its own. */
void ladder_classic_task(struct ladder *ladder, bool task);
/** ladder_import_report - of what was loaded last; NULL: it was no such project. Lives
 * until the next load. */
const struct classic_report *ladder_import_report(const struct ladder *ladder);
/** ladder_import_io - the I/O map of such a project; NULL: it has none. As long. */
const char *ladder_import_io(const struct ladder *ladder);
/** ladder_import_line - the line in such a project that line @line of what it became comes
 * from; 0: none. Of what was a rung file @line itself. @ladder is a struct ladder. */
int ladder_import_line(const void *ladder, int line);
/** ladder_import_places - the same for messages about what it became. */
void ladder_import_places(const struct ladder *ladder, struct diag_list *diags);
/** ladder_import_project - such a project as its files tell it; NULL: it was none. As
 * long. */
const struct classic_project *ladder_import_project(const struct ladder *ladder);
/** ladder_import_rung - the rung of it that became rung @rung (0-based) of POU @pou; of one
 * several may have become. NULL: it comes from none. As long. */
const struct classic_rung *ladder_import_rung(const struct ladder *ladder, int pou,
					      int rung);
/** ladder_period - from scan to scan as an imported project wants it, ns; 0: it is none,
 * or says nothing. */
int64_t ladder_period(const struct ladder *ladder);

/**
 * ladder_load - reads a rung file or a code image
 * @path: its first bytes tell which it is, not its name. Must stay valid.
 *
 * On failure nothing is loaded and ladder_diags() says why.   Scan-safe: no.
 */
bool ladder_load(struct ladder *ladder, const char *path);
/** ladder_load_text - the same from memory; @file names it in diagnostics. */
bool ladder_load_text(struct ladder *ladder, const char *file, const void *text,
		      size_t len);
/** ladder_could_read - false after a load that could not read the file at all
 * (exit status 2 of the command line). */
bool ladder_could_read(const struct ladder *ladder);

/** ladder_watch - should ladder_build also make the instrumented section, so that
 * the power of every cell can be read? Off at first; holds for later builds. */
void ladder_watch(struct ladder *ladder, bool watch);

/**
 * ladder_build - checks what was loaded and translates it to a code image
 *
 * Gives every error and warning of check/ and translate/. After it ladder_program()
 * is there. Of a loaded image it only verifies.
 */
bool ladder_build(struct ladder *ladder);

/* All of these live until the next load or ladder_free(). */
struct diag_list *ladder_diags(struct ladder *ladder);
struct project *ladder_project(struct ladder *ladder); /* NULL: an image    */
const struct program *ladder_program(const struct ladder *ladder); /* NULL  */
const void *ladder_image(const struct ladder *ladder, size_t *len);
/** ladder_il - the instruction list of POU @pou (what LD became, or as written);
 * NULL before ladder_build. */
const struct il *ladder_il(const struct ladder *ladder, int pou);
/** ladder_temporaries - variables that translation added to POU @pou. */
struct var *const *ladder_temporaries(const struct ladder *ladder, int pou,
				      int *count);
/** ladder_memory - bytes taken by project, translation and image. */
size_t ladder_memory(const struct ladder *ladder);

/* A word that could stand at a place. */
struct ladder_word {
	const char *kind;    /* "variable", "operator"                        */
	const char *text;
	const char *note;    /* its type, or what it does; "" for nothing     */
};
struct ladder_place {
	size_t prefix_len;   /* bytes before the cursor that are of the word  */
	int words;
};

/**
 * ladder_complete - what could stand before the cursor, in no order
 * @text: of the file that was loaded last; it may have errors
 * @line, @column: 1-based, bytes; the cursor stands before it
 * @take: is handed every word that begins with what stands there; NULL: none
 *
 * Owns: nothing; a word lives until @take returns.   Scan-safe: no.
 * Fails: false if there is no such place, an image was loaded, or memory is out.
 */
bool ladder_complete(struct ladder *ladder, const char *text, size_t len, int line,
		     int column,
		     void (*take)(void *context, const struct ladder_word *word),
		     void *context, struct ladder_place *place);

/**
 * ladder_functions - the functions that an expression may call, in no order
 * @begun: what stands of the name, to its dots: of words made by rule, such as
 *         INT_TO_REAL, those whose first type it has are among them
 * @take:  @word: its row; NULL: made by rule
 *
 * Owns: nothing; a word lives until @take returns.   Scan-safe: no.
 */
void ladder_functions(struct project *project, const char *begun, size_t len,
		      void (*take)(void *context, const struct ladder_word *word,
				   const struct word_row *row),
		      void *context);

/**
 * ladder_write - the canonical text of the project
 * @len: gets its length without the closing NUL
 * Owns: the caller, free().   Fails: NULL when memory is out.
 */
char *ladder_write(struct ladder *ladder, size_t *len);
/**
 * ladder_export_ladder - the project with ladders in the place of its charts
 * @diags: gets LD460 for what has none
 *
 * The text is not canonical. It declares names of its own; their spellings stay in the
 * table of names. Owns: the caller, free().   Scan-safe: no.
 * Fails: NULL after a diagnostic, or when nothing was loaded.
 */
char *ladder_export_ladder(struct ladder *ladder, size_t *len, struct diag_list *diags);
/** ladder_sfc_fits_classic - can each chart be a sequential page of ClassicLadder? Else
 * ladder_export_ladder() comes first. Scan-safe: no. */
bool ladder_sfc_fits_classic(struct ladder *ladder);
/**
 * ladder_export_classic - the project as one of ClassicLadder's (exchange/classic/to_classic.h)
 * @dialect: of ClassicLadder, of LinuxCNC, or a bare rung file
 * @lines:   of its I/O map (exchange/classic/to_classic.h); NULL: none
 * @report:  gets what means something else there
 * @diags:   gets LD730 to LD739 for what cannot be said there
 *
 * Owns: the caller, free().   Scan-safe: no.   Fails: NULL after a diagnostic, or when
 * nothing was loaded.
 */
char *ladder_export_classic(struct ladder *ladder, enum classic_dialect dialect,
			    const struct classic_lines *lines, size_t *len,
			    struct classic_report *report, struct diag_list *diags);
/**
 * ladder_outline - what ladder_write gives, and where its parts are
 * @take: is handed each part when it ends, so inner ones before outer ones; or NULL
 *
 * Owns: the caller, free().   Scan-safe: no.   Fails: NULL: no memory.
 */
char *ladder_outline(struct ladder *ladder, size_t *len,
		     void (*take)(void *context, const struct text_span *span),
		     void *context);
/** ladder_read_rung - one rung from its text: `RUNG` and its rows
 * @diags: gets what is wrong with it, with places in @text
 *
 * Its strings are ids of the project that was loaded last. Owns: the caller,
 * rung_free().   Scan-safe: no.   Fails: NULL; nothing but strings was added. */
struct rung *ladder_read_rung(struct ladder *ladder, const char *text, size_t len,
			      struct diag_list *diags);
/**
 * ladder_read_var - one declaration, `Motor AT %QX0.1 : BOOL;`, as the last one of a block
 * @pou:   its number, not of what is called with parameters; -1: a global variable
 * @block: of its table of variables; vars_pop() takes it back
 * @diags: gets what is wrong with it, with places in @text
 *
 * Scan-safe: no.   Fails: false; nothing but strings was added.
 */
bool ladder_read_var(struct ladder *ladder, int pou, int block, const char *text,
		     size_t len, struct diag_list *diags);
/** ladder_write_rung - its canonical text. Owns: the caller, free(). NULL: no memory. */
char *ladder_write_rung(struct ladder *ladder, const struct rung *rung);

/** ladder_name_fault - why nothing can have this name: DIAG_EXPECTED (it is none),
 * DIAG_RESERVED_NAME; or should not: DIAG_SHADOWS_ADDRESS; DIAG_COUNT: it is well. */
enum diag_id ladder_name_fault(const char *name);

/* Why a thing cannot be renamed. */
enum ladder_refusal {
	RENAME_GOOD,
	RENAME_NOTHING,  /* it has no name that was given to it               */
	RENAME_FORM,     /* the new one is no name                            */
	RENAME_RESERVED, /* the language has it                               */
	RENAME_TAKEN,    /* something else has it already, here               */
	RENAME_MEANING,  /* this place would mean something else then         */
	RENAME_OTHER_FILE, /* it is used here, in a file of its own           */
	RENAME_MEMORY,
};
struct ladder_rename {
	enum ladder_refusal why;
	int pou;             /* where; -1: among the globals, or nowhere      */
	int rung, row, col;  /* 1-based, as in struct xref_use; 0: none       */
	int places;          /* that change, the declaration too              */
};
/**
 * ladder_rename - a variable, member, label, POU or structure gets another name,
 * wherever it is written
 * @target: of xref/xref.h, of this project as it is
 * @how:    gets how many places change, or why none does, and where
 *
 * Nothing captures and nothing is captured: in what comes of it each name means what it
 * meant before. Of a FUNCTION the result is renamed with it. Comments, titles and other
 * files stay. The project itself is as it was.
 * Owns: the caller, free(): the canonical text with the new name.   Scan-safe: no.
 * Fails: NULL and the reason.
 */
char *ladder_rename(struct ladder *ladder, const struct xref_target *target,
		    const char *name, size_t *len, struct ladder_rename *how);
#endif
