/* SPDX-License-Identifier: MIT
 *
 * plcopen_convert - types and functions that the files of the import share. Private to
 * plcopen_*.c.
 */
#ifndef PLCOPEN_CONVERT_H
#define PLCOPEN_CONVERT_H

#include "engine/base/sink.h"
#include "engine/exchange/import.h"
#include "engine/exchange/plcopen/xml_tree.h"

enum plcopen_language {
	PLCOPEN_NONE, PLCOPEN_ST, PLCOPEN_IL, PLCOPEN_LD, PLCOPEN_FBD, PLCOPEN_SFC
};

/* A POU of the file. */
struct plcopen_pou {
	struct xml_node *node;
	const char *name;
	enum { POU_PROGRAM, POU_FUNCTION, POU_BLOCK } kind;
	struct xml_node *body;          /* the element of its language; NULL: none */
	enum plcopen_language language; /* that of the file                        */
	bool called_short;              /* a function: a call names only some inputs */
	struct { const char **name; int count; } called; /* actions of a chart that a text calls */
	const char *result;             /* the type that its own text names; NULL: none */
};

/* Text that waits until what stands above it is written. */
struct plc_part { struct sink_memory text; struct foreign_place *place; int lines; };

struct plcopen {
	struct arena *arena;
	const char *file;
	struct classic_report *report;
	struct diag_list *diags;
	struct sink_memory text;
	struct sink out;
	struct foreign_place *place; /* of the lines that are written, from line 1 on */
	int lines;
	int at;                 /* the line of the XML that is written now     */
	const char *pou_name;   /* for the report; NULL: outside of POUs        */
	int rungs;              /* rungs or networks written in this POU       */
	bool pictures;          /* those that are written now get a drawing     */
	struct drawings drawings;
	const struct xml_node *types; /* of the project; NULL: none              */
	struct xml_node *own;   /* the text of an export, beside the XML; NULL: none */
	struct plcopen_pou *pou;
	int pous;
	/* Names that change; with a list, of its variable alone, where the list is said before it. */
	struct { struct plc_rename { const char *from, *to, *list; } *one; int count; } rename;
	struct { struct plc_store *one; int count; bool found; } stores; /* plcopen_stores.c */
	int64_t address[3][4];  /* plcopen_address.c: where numbers begin, of I Q M and B W D L; -1: as they are */
	struct { const char **name; int count; } globals; /* VAR_EXTERNAL that the file declares nowhere */
	struct { const char **name; int count; } made; /* instances that the import adds to this POU */
	struct plc_part added;  /* actions that the import adds to this POU       */
	bool uses_init;         /* a body of the file names SFCInit                */
	struct { int types, pous, variables, rungs, networks, steps, own; } count;
};

/* ---- plcopen_text.c ---- */
void plc_put(struct plcopen *c, const char *format, ...) __attribute__((format(printf, 2, 3)));
/** plc_text - any text as it is; each of its lines after the first is one further in the XML. */
void plc_text(struct plcopen *c, const char *text);
/** plc_print - formatted text in the arena; "" without memory. */
const char *plc_print(struct plcopen *c, const char *format, ...)
	__attribute__((format(printf, 2, 3)));
/* Text that grows; plc_built ends it. */
struct plc_build { struct sink_memory memory; };
void plc_build(struct plc_build *build);
void plc_add(struct plc_build *build, const char *format, ...) __attribute__((format(printf, 2, 3)));
/** plc_add_text - the same of any length. */
void plc_add_text(struct plc_build *build, const char *text);
/** plc_built - the text in the arena; "" without memory. */
const char *plc_built(struct plcopen *c, struct plc_build *build);
/** plc_comment - ` (* … *)` with @text in one line; nothing for "". */
void plc_comment(struct plcopen *c, const char *text);
/** plc_flat - @text in one line, as it may stand in a comment. */
const char *plc_flat(struct plcopen *c, const char *text);
/** plc_string - @text in quotes. */
void plc_string(struct plcopen *c, const char *text);
/** plc_report - a line of the report, at @node; of a sink's format. */
void plc_report(struct plcopen *c, enum report_kind kind, const struct xml_node *node,
		const char *text, ...) __attribute__((format(printf, 4, 5)));
/** plc_documentation - the text of an element's documentation; "". */
const char *plc_documentation(struct plcopen *c, struct xml_node *node);
/** plc_is_name - whether something can have this name here. */
bool plc_is_name(const char *name);
/** plc_trim - @text without blanks around it. */
const char *plc_trim(struct plcopen *c, const char *text);
/** plc_leftovers - reports each element and attribute below @root that is not marked as taken. */
void plc_leftovers(struct plcopen *c, struct xml_node *root);
/** plc_renamed - @text with the names that the import changes, and texts in the quotes of a STRING. */
const char *plc_renamed(struct plcopen *c, const char *text);
/** plc_declared - the name that a declared variable gets. */
const char *plc_declared(struct plcopen *c, const struct xml_node *variable);
/** plc_find_renames - which names of the project nothing can have here. */
void plc_find_renames(struct plcopen *c, struct xml_node *project);
/** plc_same - whether two names are the same, in any case of ASCII letters. */
bool plc_same(const char *a, const char *b);
/** plc_pou - the POU of this name; NULL: none. */
struct plcopen_pou *plc_pou(const struct plcopen *c, const char *name);

/* ---- plcopen_library.c ---- */
/** plc_library - adds the blocks and functions of Beremiz and OpenPLC that the project uses, to its POUs. */
void plc_library(struct plcopen *c, struct xml_node *project, struct xml_node *pous);

/* ---- plcopen_list.c ---- */
/** plc_labels - an instruction list of @pou in which no label is reached with a result. @node: for the report. */
const char *plc_labels(struct plcopen *c, struct plcopen_pou *pou, const struct xml_node *node, const char *text);

/* ---- plcopen_calls.c ---- */
/** plc_is_action - whether any POU has an action of this name. */
bool plc_is_action(const struct plcopen *c, const char *name);
/** plc_find_called - which actions of charts are called by a text, which reaches those behind the chart only. */
void plc_find_called(struct plcopen *c);
/** plc_is_called - whether @name is such an action of @pou. */
bool plc_is_called(const struct plcopen_pou *pou, const char *name);
/** plc_find_short_calls - which functions are called without some of their inputs. */
void plc_find_short_calls(struct plcopen *c);
/** plc_plain_calls - @text with calls of actions that have no inputs. */
const char *plc_plain_calls(struct plcopen *c, const char *text);

/** plc_without_library - TON of Standard.TON, a block of a library that is built in here; else @name. */
const char *plc_without_library(const struct plcopen *c, const char *name);
/** plc_note_init - finds out c->uses_init, before the import adds text of its own. */
void plc_note_init(struct plcopen *c, const struct xml_node *project);

/* ---- plcopen_apart.c ---- */
/** plc_charts_apart - makes function blocks of actions that are charts. */
void plc_charts_apart(struct plcopen *c, struct xml_node *pous);

/* ---- plcopen_address.c ---- */
/** plc_counts_otherwise - whether the file is from here, from CODESYS or from TwinCAT. */
bool plc_counts_otherwise(const struct plcopen *c, const struct xml_node *project);
/** plc_find_addresses - which addresses change. */
void plc_find_addresses(struct plcopen *c, struct xml_node *project);
/** plc_moved - the address @text as it is here; NULL: it stays, or is none. */
const char *plc_moved(struct plcopen *c, const char *text, size_t len);

/* ---- plcopen_stores.c ---- */
/** plc_stores_input - whether a body stores into @variable, whose @address is that of an input. */
bool plc_stores_input(struct plcopen *c, const struct xml_node *variable, const char *address);

/* ---- plcopen_declare.c ---- */
/** plc_type - the text of a type: of the first element in @node. */
const char *plc_type(struct plcopen *c, struct xml_node *node);
/**
 * plc_address - the address of a variable or of a line of VAR_CONFIG; NULL: it has none, or one that is none here, which
 * the report tells
 * @name, @type:  of the variable, as the rung file has them
 */
const char *plc_address(struct plcopen *c, struct xml_node *variable, const char *name, const char *type);
/** plc_value - the text of an initialValue; NULL: it has none. */
const char *plc_value(struct plcopen *c, struct xml_node *node);
/** plc_types - all types of the project. */
void plc_types(struct plcopen *c, struct xml_node *types);
/** plc_variables - a block of declarations. @word: VAR … */
void plc_variables(struct plcopen *c, struct xml_node *list, const char *word);
/** plc_interface - the blocks of a POU, and the instances in c->made. */
void plc_interface(struct plcopen *c, struct plcopen_pou *pou);
/** plc_lost_globals - declares variables of VAR_EXTERNAL that are no global variables of the file. */
void plc_lost_globals(struct plcopen *c, struct xml_node *project);
/** plc_find_variable - the declaration of a variable of @pou; NULL: none. */
const struct xml_node *plc_find_variable(const struct plcopen_pou *pou, const char *name);
/** plc_make - a name for a further variable of the POU in work, which begins with @stem. Declares it
 * with this type. */
const char *plc_make(struct plcopen *c, struct plcopen_pou *pou, const char *stem,
		     const char *type);

/* ---- plcopen_own.c ---- */
/** plc_find_own - the text of an export, as c->own. */
void plc_find_own(struct plcopen *c, struct xml_node *project);
/** plc_own_project - writes all of it; false: the XML says something else, or there is none. */
bool plc_own_project(struct plcopen *c, struct xml_node *project);
/** plc_own_pou - the same of a POU, and of the actions that stand behind it. */
bool plc_own_pou(struct plcopen *c, const struct plcopen_pou *pou);
/** plc_own_others - what the XML does not have: subroutines. */
void plc_own_others(struct plcopen *c);

/* ---- plcopen_config.c ---- */
void plc_configurations(struct plcopen *c, struct xml_node *instances);

/* ---- plcopen_body.c ---- */
/** plc_find_pous - what POUs there are; before all else. */
void plc_find_pous(struct plcopen *c, struct xml_node *pous);
void plc_pous(struct plcopen *c);
/** plc_part_begin - what is written from now on waits; returns what was written so far. */
struct plc_part plc_part_begin(struct plcopen *c);
/** plc_part_swap - exchanges what is written now with @part. */
void plc_part_swap(struct plcopen *c, struct plc_part *part);
/** plc_part_append - writes all of @part, which ends. */
void plc_part_append(struct plcopen *c, struct plc_part *part);
/** plc_has_action - whether @name is an action of @pou, or, as Other.Name, of another POU. */
bool plc_has_action(const struct plcopen *c, const struct plcopen_pou *pou, const char *name);
/** plc_instance_action - whether @name, Pump.Start or Plant.Pump.Start, is an action of the block that a variable of @pou
 * is, or, of a variable from outside, of any block. */
bool plc_instance_action(const struct plcopen *c, const struct plcopen_pou *pou, const char *name);
/** plc_actions - the actions of a POU; of a chart those inside of it, or those @behind it. */
void plc_actions(struct plcopen *c, struct plcopen_pou *pou, bool behind);
/** plc_put_inner - the body of an action: text, rungs or statements. false: it has none of these. */
bool plc_put_inner(struct plcopen *c, struct plcopen_pou *pou, struct xml_node *body,
		   const char *indent);
/** plc_language - the language of a body, and its element. */
enum plcopen_language plc_language(struct xml_node *body, struct xml_node **element);

#endif
