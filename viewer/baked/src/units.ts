// Textures of light hold 16-bit floats: lux and cd/m² are divided by this, so that the sun fits in.
export const kUnit = 16;
export const kMostStored = 65000;
