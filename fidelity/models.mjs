/**
 * What is compared: files below ../shared/models, with the animation and the time of their pose if it is not the stored one.
 *
 * One or more for each thing that two renderers may take in two ways; points and lines are left out, which WebGL and pineda draw by different rules.
 */
export const MODELS = [
    { file: 'Box_With_Spaces/Box With Spaces.gltf', shows: 'texture, escaped file names' },
    { file: 'BoxVertexColors/BoxVertexColors.gltf', shows: 'vertex colours' },
    { file: 'Mesh_PrimitiveVertexColor/Mesh_PrimitiveVertexColor_03.gltf', shows: 'vertex colours of bytes with alpha' },
    { file: 'Fox/Fox.gltf', shows: 'skin, texture, no indices' },
    { file: 'Fox/Fox.gltf', animation: 'Run', time: 0.4, shows: 'animated skin' },
    { file: 'RiggedSimple/RiggedSimple.glb', animation: 0, time: 1, shows: 'animated skin' },
    { file: 'AnimatedMorphCube/AnimatedMorphCube.glb', animation: 0, time: 1.5, shows: 'animated morph targets' },
    { file: 'InterpolationTest/InterpolationTest.glb', animation: 'CubicSpline Rotation', time: 0.6, shows: 'nodes, cubic spline' },
    { file: 'MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb', shows: 'nodes, a million triangles' },
    { file: 'SimpleSparseAccessor/SimpleSparseAccessor.gltf', shows: 'sparse accessor, no normals' },
    { file: 'TextureTransformTest/TextureTransformTest.gltf', shows: 'KHR_texture_transform' },
    { file: 'TextureLinearInterpolationTest/TextureLinearInterpolationTest.glb', shows: 'filtering in linear light, MASK' },
    { file: 'extra/unlit.gltf', shows: 'nearest filter, clamped and mirrored' },
    { file: 'WaterBottle/WaterBottle.gltf', shows: 'textures of 2048 x 2048, mip levels' },
    { file: 'NormalTangentTest/NormalTangentTest.glb', shows: 'double-sided surfaces' },
    { file: 'TwoSidedPlane/TwoSidedPlane.gltf', shows: 'double-sided plane' },
    { file: 'Material_AlphaMask/Material_AlphaMask_06.gltf', shows: 'MASK, factor and cutoff' },
    { file: 'Material_AlphaBlend/Material_AlphaBlend_06.gltf', shows: 'BLEND, texture and vertex colours' },
    { file: 'GlassVaseFlowers/GlassVaseFlowers.glb', shows: 'MASK and BLEND, double-sided' },
    { file: 'LightsPunctualLamp/LightsPunctualLamp.gltf', shows: 'nodes, BLEND, JPEG' },
    { file: 'spot/spot_textured.obj', shows: 'OBJ, MTL, texture' },
    { file: 'plane/plane.obj', shows: 'OBJ with normals' },
    { file: 'trimesh-stl/featuretype.STL', shows: 'STL, binary' },
    { file: 'extra/spot_ascii.stl', shows: 'STL, ASCII' },
    { file: 'trimesh-ply/featuretype.ply', shows: 'PLY without normals' },
    { file: 'extra/spot_ascii_normals_colours.ply', shows: 'PLY with normals and colours' },
    { file: 'extra/terrain_524k.ply', shows: 'PLY, half a million triangles' },
];

export const MODES = ['unlit', 'lambert', 'normals', 'depth'];
