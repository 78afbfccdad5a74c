\echo Use "CREATE EXTENSION typify" to load this file. \quit

