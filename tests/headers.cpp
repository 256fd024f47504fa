// Precompiled headers of the tests need a file to belong to.
