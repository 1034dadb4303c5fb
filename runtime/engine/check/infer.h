/* SPDX-License-Identifier: MIT
 *
 * infer - the types of the parts of an expression, before anything is computed.
 *
 * The translation of expressions asks it, and wires of networks (check/wires.h) get their types from it.
 */
#ifndef CHECK_INFER_H
#define CHECK_INFER_H

#include "engine/check/scope.h"
#include "engine/model/expr.h"
#include "engine/model/expr_args.h"

struct infer {
	struct scope *scope;
	const struct pou *pou;
	struct project *project;
	struct expr *expr;   /* the sides of a sum may be turned in it        */
	bool statement;      /* of Structured Text or a network (check/mixed.h) */
	bool pointless;      /* constants with a point have no type           */
};

/* None of them is scan-safe. IEC_NONE: constants without a type, a whole structure or array, or an error. */
/** infer_type - of the node with this index; constants without a type take that of their neighbours. */
enum iec_type infer_type(struct infer *c, int index);
/** infer_wanted - the same where @hint is wanted: an LREAL, if only constants make it a REAL. */
enum iec_type infer_wanted(struct infer *c, int index, enum iec_type hint);
/** infer_operand - of an operand, a string id. */
enum iec_type infer_operand(struct infer *c, uint32_t operand);
/** infer_mixes - are they a bit string and a number, or two bit strings, in arithmetic of Structured Text? */
bool infer_mixes(const struct infer *c, enum iec_type left, enum iec_type right);
/** infer_logic - of AND OR XOR NOT: BOOL, unless a side is a bit string that the other fits. */
enum iec_type infer_logic(struct infer *c, const struct expr_node *node);
/** infer_function - the function of an EXPR_CALL; WORD_COUNT: none. */
enum word infer_function(const struct infer *c, const struct expr_node *node);
/** infer_result - the result of a function of the project, as declared; NULL: it is none. */
const struct var *infer_result(const struct infer *c, enum word word);
/** infer_overload - the overload of a word for these arguments. */
enum word infer_overload(struct infer *c, enum word word, const struct expr_args *args);
/** infer_shared - the type that the inputs share. */
enum iec_type infer_shared(struct infer *c, const struct word_row *row, const struct expr_args *args);
/** infer_work - the type that the function works on: of SHL on an INT it is WORD. */
enum iec_type infer_work(struct infer *c, const struct word_row *row, const struct expr_args *args);
/** infer_back - of its result, if it works on @work instead of @type. */
enum iec_type infer_back(enum iec_type type, enum iec_type work);
/** infer_is_roomy - does a constant of the operation need a wider type than the other side has? */
bool infer_is_roomy(struct infer *c, const struct expr_node *node);
/** infer_bits - the type of so many bits. */
enum iec_type infer_bits(unsigned int bits);
/** infer_is_power - are base and exponent of a power integers, or constants without a point? */
bool infer_is_power(struct infer *c, int base, int exponent);
/** infer_power - of a power: that of the base, or REAL as the exponent. */
enum iec_type infer_power(struct infer *c, int base, int exponent);
/** infer_is_whole_power - EXPT(base, exponent) of integers; @args: its arguments. */
bool infer_is_whole_power(struct infer *c, enum word word, const struct expr_args *args);

/** infer_is_root - EXPT(base, exponent) of an integer and a REAL or LREAL; @args: its arguments. */
bool infer_is_root(struct infer *c, enum word word, const struct expr_args *args);
#endif
