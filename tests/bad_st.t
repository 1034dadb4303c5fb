#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# bad_st.t - what `ladder check` says about mistakes that people make in Structured Text and in networks.
#
# tests/bad/st.cases and fbd.cases have a case each: its name, the text, and behind --- the messages. A text that
# does not begin with a word of a file stands in a program that declares the variables below.
# `tests/bad_st.t --bless` writes the messages anew; a person reads the difference.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $tests = abs_path(dirname(__FILE__));
my $build = $ENV{BUILD} // "$tests/../build";
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);

my $language = 'ST';
my $declared = <<'END';
RUNGBOARD 1
VAR CONSTANT Limit : INT := 3; END_VAR
VAR
  Sensor AT %IW0 : INT; A, B, C, i : INT; D : DINT; U : UINT; R : REAL; By : BYTE; On, Stop : BOOL;
  Delay : TIME; Name : STRING[20]; T : ARRAY[1..5] OF INT; Wait : TON;
END_VAR
END

# The file of a case, and how many lines stand above its text.
sub program {
	my ($text) = @_;
	return ($text, 0) if $text =~ /^(?:\xef\xbb\xbf)?(?:P\0R\0|RUNGBOARD|PROGRAM|FUNCTION|FUNCTION_BLOCK|TYPE|VAR|VAR_GLOBAL\b)/;
	my $head = $declared . "PROGRAM Main $language\n";

	return ("$head$text" . "END_PROGRAM\n", scalar(() = $head =~ /\n/g));
}

# Messages with the line in the text of the case: 2:5: error …
sub messages {
	my ($text) = @_;
	my ($whole, $above) = program($text);
	my $name = $whole =~ /^RUNGBOARD/ ? 'main.rung' : 'main.st';
	spew("$folder/$name", $whole);
	my ($status, $said) = answer($folder, $ladder, 'check', $name);
	return "signal $status\n" if $status & 127;
	my @lines = grep { !/^\S+: \d+ (?:error|warning)/ } split /\n/, $said;
	s/^\Q$name\E:(\d+)/$1 - $above/e for @lines;
	# What is told about the declarations around the text is not about the mistake.
	return join '', map { "$_\n" } grep { !/^\Q$name\E: good/ && !/^-\d+: warning/ } @lines;
}

my %most = (ST => 80, FBD => 40);
for my $file (map { "$tests/bad/$_.cases" } qw(st fbd)) {
	my (@cases, $out, %seen);

	$language = $file =~ /fbd.cases$/ ? 'FBD' : 'ST';
	open my $in, '<', $file or die "$file: $!";
	{
		local $/;
		my $all = <$in>;
		push @cases, [$1, $2, $3 // ''] while $all =~ /^=== (.*)\n((?:(?!===|---).*\n)*)(?:---\n((?:(?!===).*\n)*))?/mg;
	}
	for my $case (@cases) {
		my ($name, $text, $want) = @$case;
		my $said = messages($text);
		$said = "good\n" if $said eq '';
		is($said, $want, $name);
		# A second mistake below the first one is told as well; a comment that is not closed takes it in.
		if ($language eq 'ST' && (program($text))[1] && $want =~ /error LD[12]\d\d|error LD39/ && $name !~ /comment that is not closed/) {
			my $second = 1 + ($text =~ tr/\n//);
			like(messages("${text}A := B + ;\n"), qr/^$second(?::\d+)*: error /m, "$name: the next mistake is found, too");
		}
		ok(!$seen{$name}++, "$name: one case of this name");
		$out .= "=== $name\n$text---\n$said";
	}
	cmp_ok(scalar(@cases), '>=', $most{$language}, "at least $most{$language} mistakes in $language");
	if (@ARGV && $ARGV[0] eq '--bless') {
		spew($file, $out);
		diag("$file is written; read the difference");
	}
}
$language = 'ST';
# What a text file cannot show.
my %bytes = (
	'CRLF' => ["A := 1;\r\nB = 2;\r\n", qr/^2:1: error LD231/],
	'a BOM' => ["\xef\xbb\xbfPROGRAM Main\nVAR A : INT; END_VAR\nA = 1;\nEND_PROGRAM\n", qr/^3:1: error LD231/],
	'UTF-16' => [join("\0", split //, "PROGRAM Main\nVAR A : INT; END_VAR\nA := 1;\nEND_PROGRAM\n") . "\0", qr/error LD\d+: .*UTF-8/],
	'a megabyte on a line' => ['A := 1' . ' + 1' x 262144 . ";\nB = 2;\n", qr/error LD/],
	'a megabyte of parentheses' => ['A := ' . '(' x 1048576 . ";\nB = 2;\n", qr/error LD/],
	'a megabyte of IF' => ["IF On THEN\n" x 90000 . "B = 2;\n", qr/error LD/],
	'a megabyte in a name' => ['A' x 1048576 . " := 1;\nB = 2;\n", qr/error LD/],
	'a NUL' => ["A := 1;\0\nB = 2;\n", qr/error LD/],
);
for my $name (sort keys %bytes) {
	my ($text, $want) = @{$bytes{$name}};
	my $said = messages($text);
	like($said, $want, $name);
	ok(length $said < 60000, "$name: the messages are short");
}
done_testing;
